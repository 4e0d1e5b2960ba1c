// Work that goes on beside the caller's, one piece at a time.
#pragma once

#include <chrono>
#include <functional>
#include <future>

namespace cli {

class BackgroundTask {
public:
    // Begins work in a thread, or does it here where there is none to be had. None may be under way.
    void start(std::function<void()> work) {
        future_ = std::async(std::launch::async | std::launch::deferred, std::move(work));
        if (future_.wait_for(std::chrono::seconds(0)) == std::future_status::deferred)
            future_.wait();
    }

    // Whether work has not ended yet.
    bool is_under_way() const {
        return future_.valid() && future_.wait_for(std::chrono::seconds(0)) == std::future_status::timeout;
    }

    // Whether there is an end that finish() has not told yet.
    bool is_begun() const { return future_.valid(); }

    // Waits for its end, and throws what it threw.
    void finish() {
        if (future_.valid())
            future_.get();
    }

private:
    std::future<void> future_; // destroyed, it waits for its thread
};

} // namespace cli
