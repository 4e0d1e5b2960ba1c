#include "cli/base/interrupt.h"

#include "lib/platform/terminal.h"

#include <atomic>
#include <chrono>
#include <cstdint>

namespace cli {
namespace {

std::atomic<int> noted_signal = 0;
std::atomic<std::int64_t> noted_at = 0;
std::atomic<bool> noted_picture_request = false;
std::atomic<bool> ends_at_once = false;
static_assert(decltype(noted_signal)::is_always_lock_free && decltype(noted_at)::is_always_lock_free &&
                  decltype(noted_picture_request)::is_always_lock_free && decltype(ends_at_once)::is_always_lock_free,
              "only lock-free atomics are safe in a signal handler");

// timeout(1) signals both the program and its process group, so one cause gives two signals.
bool note_signal(int signal) {
    constexpr std::int64_t same_cause = 1'000'000'000;
    const std::int64_t now = std::chrono::steady_clock::now().time_since_epoch() / std::chrono::nanoseconds(1);
    if (ends_at_once)
        return true;
    if (noted_signal != 0)
        return now - noted_at > same_cause;
    noted_at = now;
    noted_signal = signal;
    return false;
}

void note_picture_request() {
    noted_picture_request = true;
}

} // namespace

EndAtOnce::EndAtOnce() {
    ends_at_once = true;
}

EndAtOnce::~EndAtOnce() {
    ends_at_once = false;
}

void catch_signals() {
    platform::catch_signals(&note_signal, &note_picture_request);
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
    const int signal = interrupt_signal();
    return signal == platform::hangup ? "SIGHUP" : signal == platform::interruption ? "SIGINT" : "SIGTERM";
}

} // namespace cli
