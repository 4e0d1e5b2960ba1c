// Which thread has a call on a context under way: neither the film nor Vulkan allows two calls at a time.
#pragma once

#include <atomic>
#include <thread>

namespace pt {

class InUse {
public:
    // Takes the context for a call of this thread and returns NULL, or returns why that is not possible.
    const char *take() noexcept {
        std::thread::id user; // nobody
        if (user_.compare_exchange_strong(user, std::this_thread::get_id(), std::memory_order_acquire))
            return nullptr;
        return user == std::this_thread::get_id() ? "called from a callback of its own context"
                                                  : "this context is in use by another thread";
    }

    // Ends the call that took it.
    void release() noexcept { user_.store(std::thread::id(), std::memory_order_release); }

    bool by_this_thread() const noexcept {
        return user_.load(std::memory_order_relaxed) == std::this_thread::get_id(); // only this thread makes it so
    }

private:
    std::atomic<std::thread::id> user_{};
};

} // namespace pt
