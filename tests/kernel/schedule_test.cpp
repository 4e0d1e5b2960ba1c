#include "lib/code/own_kernel_clock.h"
#include "lib/render/schedule.h"
#include "lib/render/tile_tasks.h"
#include "shaders/gpu_layout.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <limits>
#include <numeric>
#include <random>
#include <utility>
#include <vector>

namespace {

constexpr double overhead = 1e-4;
constexpr double paths_of_tile = pt::gpu::WORKGROUP_SIZE;

using Device = std::function<double(double paths_before, double paths)>;

Device constant_device(double paths_per_second) {
    return [=](double, double paths) { return overhead + paths / paths_per_second; };
}

// The speed falls to a tenth after `paths_until_then` paths.
Device throttled_device(double paths_per_second, double paths_until_then) {
    return [=](double before, double paths) {
        return overhead + paths / (before < paths_until_then ? paths_per_second : 0.1 * paths_per_second);
    };
}

Device noisy_device(double paths_per_second) {
    return [=, generator = std::mt19937(1)](double, double paths) mutable {
        const double exponent = std::ldexp(static_cast<double>(generator()), -31) - 1.0;
        return (overhead + paths / paths_per_second) * std::pow(1.5, exponent);
    };
}

struct Step {
    std::uint32_t tile_count;
    std::uint64_t samples;
    double seconds;

    double paths() const { return pt::paths_of(tile_count, samples); }
};

// Tests of whole films notice lost tiles and samples.
std::vector<Step> simulate(std::uint32_t tile_count, std::uint64_t samples, const pt::ScheduleLimits &limits,
                           const Device &device) {
    std::vector<std::uint32_t> all(tile_count);
    std::iota(all.begin(), all.end(), 0U);
    pt::TileTasks tasks(pt::SampleSet(), 0, all, samples);
    pt::Schedule schedule(limits);
    std::vector<Step> steps;
    double paths_done = 0.0;
    double largest = std::max(limits.first_slice_paths, paths_of_tile) / 2.0;
    while (!tasks.empty() && steps.size() < 1'000'000) {
        const pt::TileSlice slice = tasks.next(schedule);
        Step step{static_cast<std::uint32_t>(slice.tiles.size()), slice.samples.count(), 0.0};
        step.seconds = device(paths_done, step.paths());
        schedule.measured(step.paths(), step.seconds);
        EXPECT_TRUE(step.tile_count == tile_count || step.samples == 1) << "several samples of some tiles";
        EXPECT_LE(step.samples, limits.max_samples);
        EXPECT_LE(step.paths(), 2.0 * largest) << "growth beyond twofold";
        largest = std::max(largest, step.paths());
        steps.push_back(step);
        paths_done += step.paths();
        tasks.leave_behind(slice.tiles.size());
    }
    EXPECT_EQ(paths_done, pt::paths_of(tile_count, samples));
    return steps;
}

pt::ScheduleLimits usual_limits() {
    return {0.05, 16384.0, 1024};
}

struct DeviceCase {
    const char *name;
    std::uint32_t tile_count;
    std::uint64_t samples;
    Device device;
    // After warm-up, at least this fraction of the full slices takes half to twice the target time.
    double on_target;
};

constexpr std::size_t warm_up = 20;

double share_on_target(const std::vector<Step> &steps, const pt::ScheduleLimits &limits) {
    int judged = 0;
    int good = 0;
    for (std::size_t i = warm_up; i + 1 < steps.size(); ++i) {
        ++judged;
        good += steps[i].seconds <= 2.0 * limits.target_seconds && steps[i].seconds >= 0.5 * limits.target_seconds;
    }
    return judged > 0 ? static_cast<double>(good) / judged : 1.0;
}

constexpr std::uint32_t full_hd = 240 * 135;

TEST(Schedule, DoesAllWorkOnceNearTheTarget) {
    const DeviceCase cases[] = {
        {"whole samples", 25 * 10, 20000, constant_device(1e8), 1.0},
        {"samples tile by tile", full_hd, 20, constant_device(1e6), 1.0},
        {"about a sample", 800, 300, constant_device(1.03e6), 1.0},
        {"a fast GPU", full_hd, 5000, constant_device(3e9), 1.0},
        {"speed falls to a tenth", full_hd, 400, throttled_device(1e8, 2e8), 0.99},
        {"speed falls below a sample", full_hd, 100, throttled_device(1e8, 5e7), 0.99},
        // Two times differ by a factor > 2 with the probability (1 - ln 2 / (2 ln 1.5))^2 = 0.02.
        {"a noisy clock", 25 * 10, 200000, noisy_device(1e8), 0.95}};
    for (const DeviceCase &each : cases) {
        SCOPED_TRACE(each.name);
        const std::vector<Step> steps = simulate(each.tile_count, each.samples, usual_limits(), each.device);
        ASSERT_GT(steps.size(), warm_up + 1) << "nothing to judge";
        EXPECT_GE(share_on_target(steps, usual_limits()), each.on_target);
    }
}

TEST(Schedule, VerySlowDevicesGetOneTileAtATime) {
    const std::vector<Step> steps = simulate(16, 30, usual_limits(), constant_device(1000.0));
    for (std::size_t i = 30; i + 1 < steps.size(); ++i)
        ASSERT_EQ(steps[i].tile_count, 1U);
}

// Slices have a largest size, because some drivers limit loop rounds.
TEST(Schedule, VeryFastDevicesGetTheLargestSlice) {
    for (const std::uint32_t most : {3U, 1024U}) {
        pt::ScheduleLimits limits = usual_limits();
        limits.max_samples = most;
        const std::vector<Step> steps = simulate(16, std::uint64_t{most} << 6, limits, constant_device(1e15));
        for (std::size_t i = warm_up; i + 1 < steps.size(); ++i)
            ASSERT_EQ(steps[i].samples, most);
    }
}

TEST(Schedule, HoldsTheLargestSampleCount) {
    constexpr std::uint32_t most = UINT32_MAX;
    pt::ScheduleLimits limits = usual_limits();
    limits.max_samples = most;
    simulate(1, most, limits, constant_device(1e15));
}

TEST(Schedule, SlicesAreLargerThanHalfOfTheBudget) {
    const pt::Schedule schedule(usual_limits());
    EXPECT_EQ(schedule.tiles(257, 1), 129U);
    EXPECT_EQ(schedule.tiles(257 - 129, 1), 128U);
    EXPECT_EQ(schedule.samples(257, 10), 1U);
    EXPECT_EQ(schedule.samples(64, 10), 4U);
    EXPECT_EQ(schedule.samples(64, 3), 3U);
    EXPECT_EQ(schedule.tiles(64, 4), 64U);
}

TEST(Schedule, LearnsFromASliceOfFullSizeAtOnce) {
    constexpr double infinity = std::numeric_limits<double>::infinity();
    constexpr double not_a_number = std::numeric_limits<double>::quiet_NaN();
    for (const auto &[seconds, budget] : {std::pair{0.05, 16384.0},
                                          {0.1, 8192.0},
                                          {0.8, 1024.0},
                                          {0.04, 20480.0},
                                          {0.025, 32768.0},
                                          {0.001, 32768.0},
                                          {1e-300, 32768.0},
                                          {0.0, 32768.0},
                                          {1e9, 64.0},
                                          {infinity, 64.0},
                                          {-1.0, 16384.0},
                                          {-infinity, 16384.0},
                                          {not_a_number, 16384.0}}) {
        pt::Schedule schedule(usual_limits());
        schedule.measured(schedule.budget(), seconds);
        EXPECT_EQ(schedule.budget(), budget) << seconds;
    }
    EXPECT_EQ(pt::Schedule({0.05, 0.25, 1}).budget(), 64.0);
}

// The time of a slice of one tile is mostly overhead, so the device is 78 times as fast as it seems.
TEST(Schedule, SmallSlicesChangeLittle) {
    pt::ScheduleLimits limits = usual_limits();
    limits.first_slice_paths = 5e6;
    pt::Schedule schedule(limits);
    schedule.measured(paths_of_tile, overhead);
    EXPECT_NEAR(schedule.budget(), 5e6, 0.01 * 5e6);
}

TEST(Schedule, WhatWasExpectedTeachesNothing) {
    pt::Schedule schedule(usual_limits());
    EXPECT_EQ(schedule.expected_seconds(64 * 128), 0.025) << "half of the budget";
    for (const double samples : {1.0, 128.0, 256.0})
        schedule.measured(64 * samples, schedule.expected_seconds(64 * samples));
    EXPECT_EQ(schedule.budget(), 16384.0);
}

TEST(ScheduleJudge, SeesSlicesOffTarget) {
    for (const double seconds : {0.11, 0.02})
        EXPECT_EQ(share_on_target(std::vector<Step>(100, Step{16, 1, seconds}), usual_limits()), 0.0);
}

TEST(OwnKernelClockTest, WaitsTwiceAsLongAfterEachThatWasBuiltInVain) {
    pt::OwnKernelClock clock;
    for (double wait = 1.0; wait < 32.0; wait *= 2.0) {
        EXPECT_FALSE(clock.is_time(wait)) << wait;
        EXPECT_TRUE(clock.is_time(wait + 0.01)) << wait;
        clock.left_after(0.99);
    }
    clock.left_after(0.0);
    EXPECT_FALSE(clock.is_time(32.0));
    EXPECT_TRUE(clock.is_time(32.01)) << "but never longer";
    clock.left_after(1.0);
    EXPECT_TRUE(clock.is_time(1.01)) << "one has paid";
}

TEST(OwnKernelClockTest, WhatIsBuiltInVainIsAShareOfTheTime) {
    for (const double stop : {0.5, 1.1, 2.3, 5.0, 9.0, 31.0, 33.0}) {
        pt::OwnKernelClock clock;
        clock.left_after(0.0);
        int in_vain = 0;
        for (double time = 0.0; time < 1000.0; time += stop) {
            double wait = 0.0;
            while (wait < stop && !clock.is_time(wait))
                wait += 0.05;
            if (wait >= stop)
                continue;
            in_vain += stop - wait < pt::OwnKernelClock::seconds_to_pay ? 1 : 0;
            clock.left_after(stop - wait);
        }
        EXPECT_LE(in_vain, 5 + static_cast<int>(1000.0 / pt::OwnKernelClock::longest_wait)) << stop;
    }
}

} // namespace
