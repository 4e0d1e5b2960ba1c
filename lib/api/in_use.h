// Records which thread has a call running on a context, because film and Vulkan allow one, and which process owns it,
// because a forked child lacks the driver's threads.
#pragma once

#include "lib/platform/process.h"

#include <atomic>
#include <thread>

namespace pt {

class InUse {
public:
    // Takes the context for a call of this thread. Returns NULL, or the reason for a refusal.
    const char *take() noexcept {
        if (const char *reason = not_of_this_process())
            return reason;
        std::thread::id user; // nobody
        if (user_.compare_exchange_strong(user, std::this_thread::get_id(), std::memory_order_acquire))
            return nullptr;
        return user == std::this_thread::get_id() ? "called from a callback of its own context"
                                                  : "this context is in use by another thread";
    }

    void release() noexcept { user_.store(std::thread::id(), std::memory_order_release); }

    bool by_this_thread() const noexcept {
        return user_.load(std::memory_order_relaxed) ==
               std::this_thread::get_id(); // relaxed: only this thread can make it equal
    }

    // The reason why no call of this process may touch the context, or NULL. Thread-safe.
    const char *not_of_this_process() const noexcept {
        return platform::process_number() == process_
                   ? nullptr
                   : "this context belongs to the process that this one was forked from";
    }

private:
    const std::int64_t process_ = platform::process_number();
    std::atomic<std::thread::id> user_{};
};

} // namespace pt
