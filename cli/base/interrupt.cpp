#include "cli/base/interrupt.h"

#include <atomic>
#include <csignal>

namespace cli {
namespace {

std::atomic<int> noted_signal = 0;
static_assert(std::atomic<int>::is_always_lock_free, "only lock-free atomics are safe in a signal handler");

extern "C" void note_signal(int signal) {
    noted_signal = signal;
}

} // namespace

void catch_interrupts() {
    for (const int signal : {SIGINT, SIGTERM, SIGHUP}) {
        struct sigaction old {};
        sigaction(signal, nullptr, &old);
        if (old.sa_handler == SIG_IGN) {
            continue; // whoever started this program wants it so: a background job, nohup
        }
        struct sigaction action {};
        action.sa_handler = &note_signal;
        action.sa_flags = static_cast<int>(SA_RESTART | SA_RESETHAND);
        sigemptyset(&action.sa_mask);
        sigaction(signal, &action, nullptr);
    }
}

int interrupt_signal() {
    return noted_signal;
}

std::string interrupt_name() {
    switch (interrupt_signal()) {
    case SIGINT:
        return "SIGINT";
    case SIGHUP:
        return "SIGHUP";
    default:
        return "SIGTERM";
    }
}

} // namespace cli
