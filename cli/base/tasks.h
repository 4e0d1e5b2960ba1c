// Work beside that of the caller: in the background, or shared by all processors of the machine.
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
    // Begins work in a thread, or does it at once if there is none to be had. No other work may be under way.
    void start(std::function<void()> work) {
        future_ = std::async(std::launch::async | std::launch::deferred, std::move(work));
        if (future_.wait_for(std::chrono::seconds(0)) == std::future_status::deferred)
            future_.wait();
    }

    // Whether work has not ended yet.
    bool is_under_way() const {
        return future_.valid() && future_.wait_for(std::chrono::seconds(0)) == std::future_status::timeout;
    }

    // Whether work has been begun for which finish() has not been called yet.
    bool is_begun() const { return future_.valid(); }

    // Waits until the work ends, and throws what it threw.
    void finish() {
        if (future_.valid())
            future_.get();
    }

private:
    std::future<void> future_; // destroyed, it waits for its thread
};

// Calls work(first, end) for consecutive parts of [0, count): the last in this thread, the others in threads of their
// own if the system has any left. grain: the least size of a part except the last, for which starting a thread pays. An
// exception of work is thrown on when all parts that were begun have ended.
template <typename Work>
void in_parallel(std::size_t count, std::size_t grain, const Work &work) {
    const std::size_t processors = std::max(std::thread::hardware_concurrency(), 1U);
    const std::size_t part = std::max((count + processors - 1) / processors, grain);
    std::vector<std::future<void>> others; // destroyed, they wait for their threads
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
