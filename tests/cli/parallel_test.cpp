#include "cli/base/tasks.h"

#include <gtest/gtest.h>

#include <atomic>
#include <stdexcept>
#include <vector>

namespace {

TEST(Parallel, EveryThingIsWorkedOnOnce) {
    for (const std::size_t count : {0U, 1U, 7U, 1000U, 1001U}) {
        for (const std::size_t grain : {1U, 3U, 1000U, 5000U}) {
            std::vector<int> turns(count);
            std::atomic<std::size_t> small_parts = 0;
            cli::in_parallel(count, grain, [&](std::size_t first, std::size_t end) {
                small_parts += end - first < grain;
                for (std::size_t i = first; i < end; ++i)
                    ++turns[i];
            });
            EXPECT_EQ(turns, std::vector<int>(count, 1)) << count << " in parts of " << grain;
            EXPECT_LE(small_parts, 1U) << count << " in parts of " << grain;
        }
    }
}

TEST(Parallel, WhatIsThrownIsThrownWhenAllHaveEnded) {
    std::atomic<int> ended = 0;
    std::atomic<int> begun = 0;
    const auto work = [&](std::size_t first, std::size_t) {
        ++begun;
        if (first == 0)
            throw std::runtime_error("no");
        ++ended;
    };
    EXPECT_THROW(cli::in_parallel(100, 1, work), std::runtime_error);
    EXPECT_EQ(ended, begun - 1);
}

} // namespace
