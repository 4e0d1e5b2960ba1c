// Work on many equal things, shared by the machine's processors.
#pragma once

#include <algorithm>
#include <cstddef>
#include <future>
#include <thread>
#include <vector>

namespace cli {

// Calls work(first, end) for consecutive parts of [0, count): the last in this thread, the others in threads of their
// own where there are any to be had. grain: parts are no smaller, but for the last; as much as makes a thread worth its
// start. What work throws is thrown when all that were begun have ended.
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
