#pragma once

#include <algorithm>
#include <chrono>
#include <cstddef>
#include <functional>
#include <future>
#include <thread>
#include <vector>

namespace cli {

class BackgroundTask {
public:
    // Runs work in a thread, or immediately on a system without threads. No other work may be running.
    void start(std::function<void()> work) {
        future_ = std::async(std::launch::async | std::launch::deferred, std::move(work));
        if (future_.wait_for(std::chrono::seconds(0)) == std::future_status::deferred)
            future_.wait();
    }

    bool is_under_way() const {
        return future_.valid() && future_.wait_for(std::chrono::seconds(0)) == std::future_status::timeout;
    }

    bool is_begun() const { return future_.valid(); }

    void finish() {
        if (future_.valid())
            future_.get();
    }

private:
    std::future<void> future_; // the destructor waits for the thread
};

// Calls work(first, end) for parts of [0, count) with at least `grain` items. After all have ended, rethrows an
// exception of one of them.
template <typename Work>
void in_parallel(std::size_t count, std::size_t grain, const Work &work) {
    const std::size_t processors = std::max(std::thread::hardware_concurrency(), 1U);
    const std::size_t part = std::max((count + processors - 1) / processors, grain);
    std::vector<std::future<void>> others;
    std::size_t first = 0;
    for (; first + part < count; first += part) {
        others.push_back(
            std::async(std::launch::async | std::launch::deferred, [&, first] { work(first, first + part); }));
    }
    work(first, count);
    for (std::future<void> &other : others)
        other.get();
}

} // namespace cli
