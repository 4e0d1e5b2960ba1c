#include "cli/base/interrupt.h"

#include <atomic>
#include <csignal>
#include <cstdint>
#include <cstring>
#include <ctime>

namespace cli {
namespace {

std::atomic<int> noted_signal = 0;
std::atomic<std::int64_t> noted_at = 0; // nanoseconds
std::atomic<bool> noted_picture_request = false;
static_assert(decltype(noted_signal)::is_always_lock_free && decltype(noted_at)::is_always_lock_free &&
                  decltype(noted_picture_request)::is_always_lock_free,
              "only lock-free atomics are safe in a signal handler");

std::int64_t nanoseconds_now() {
    timespec now{};
    clock_gettime(CLOCK_MONOTONIC, &now);
    return std::int64_t{now.tv_sec} * 1'000'000'000 + now.tv_nsec;
}

// timeout(1) sends its signal to the program and to its process group, so that it comes twice at once.
extern "C" void note_signal(int signal) {
    constexpr std::int64_t same_cause = 1'000'000'000;
    const std::int64_t now = nanoseconds_now();
    if (noted_signal != 0 && now - noted_at > same_cause) {
        std::signal(signal, SIG_DFL);
        raise(signal); // comes when this handler returns
        return;
    }
    if (noted_signal == 0) {
        noted_at = now;
        noted_signal = signal;
    }
}

extern "C" void note_picture_request(int) {
    noted_picture_request = true;
}

void handle(int signal, void (*handler)(int)) {
    struct sigaction action {};
    action.sa_handler = handler;
    action.sa_flags = SA_RESTART;
    sigemptyset(&action.sa_mask);
    sigaction(signal, &action, nullptr);
}

} // namespace

void catch_signals() {
    for (const int signal : {SIGINT, SIGTERM, SIGHUP}) {
        struct sigaction old {};
        sigaction(signal, nullptr, &old);
        if (old.sa_handler != SIG_IGN) // whoever started this program wants that: a background job, nohup
            handle(signal, &note_signal);
    }
    handle(SIGUSR1, &note_picture_request);
}

bool has_picture_request() {
    return noted_picture_request;
}

void forget_picture_request() {
    noted_picture_request = false;
}

int interrupt_signal() {
    return noted_signal;
}

std::string interrupt_name() {
    return std::string("SIG") + sigabbrev_np(interrupt_signal());
}

} // namespace cli
