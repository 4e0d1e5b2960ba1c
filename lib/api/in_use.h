// Records which thread is in a call on a context, because only one may be. Also records which process made the context,
// because a forked child lacks the driver's threads.
#pragma once

#include "lib/platform/process.h"

#include <atomic>
#include <thread>

namespace pt {

class InUse {
public:
    // Marks the context as used by this thread. Returns NULL, or the reason for a refusal.
    const char *take() noexcept {
        if (const char *reason = not_of_this_process())
            return reason;
        std::thread::id user;
        if (user_.compare_exchange_strong(user, std::this_thread::get_id(), std::memory_order_acquire))
            return nullptr;
        return user == std::this_thread::get_id() ? "called from a callback of its own context"
                                                  : "this context is in use by another thread";
    }

    void release() noexcept { user_.store(std::thread::id(), std::memory_order_release); }

    bool by_this_thread() const noexcept {
        return user_.load(std::memory_order_relaxed) ==
               std::this_thread::get_id(); // relaxed, because only this thread stores its id
    }

    // Returns why this process must not use the context, or NULL. Thread-safe.
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
