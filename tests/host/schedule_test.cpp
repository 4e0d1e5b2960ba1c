// Slices on simulated devices: all work is done exactly once, near the target time, within the limits, growing slowly.
#include "lib/render/schedule.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <ostream>
#include <random>
#include <string>
#include <utility>
#include <vector>

namespace {

constexpr double overhead = 1e-4; // seconds of every submission

double paths_of(const pt::Slice &slice) {
    return static_cast<double>(slice.pixel_count) * slice.sample_count;
}

// Seconds that a slice takes when paths have been followed before it.
using Device = std::function<double(double paths_before, double paths)>;

Device constant_device(double paths_per_second) {
    return [=](double, double paths) { return overhead + paths / paths_per_second; };
}

// Its speed falls to a tenth on the way.
Device throttled_device(double paths_per_second, double paths_until_then) {
    return [=](double before, double paths) {
        return overhead + paths / (before < paths_until_then ? paths_per_second : 0.1 * paths_per_second);
    };
}

// Times scatter within a factor of 1.5, evenly in their logarithm.
Device noisy_device(double paths_per_second) {
    return [=, generator = std::mt19937(1)](double, double paths) mutable {
        const double exponent = std::ldexp(static_cast<double>(generator()), -31) - 1.0; // in [-1, 1)
        return (overhead + paths / paths_per_second) * std::pow(1.5, exponent);
    };
}

struct Step {
    pt::Slice slice;
    double seconds;
};

// Runs a schedule as Renderer does, cancelled by nobody.
std::vector<Step> simulate(std::uint32_t pixel_count, std::uint32_t samples, const pt::ScheduleLimits &limits,
                           Device device) {
    pt::Schedule schedule(pixel_count, limits);
    std::vector<Step> steps;
    std::uint32_t samples_done = 0;
    std::uint32_t pass_pixels_done = 0;
    double paths_done = 0.0;
    while (samples_done < samples && steps.size() < 1'000'000) {
        const pt::Slice slice = schedule.next(samples - samples_done, pass_pixels_done);
        const double seconds = device(paths_done, paths_of(slice));
        schedule.measured(slice, seconds);
        steps.push_back({slice, seconds});
        paths_done += paths_of(slice);
        pass_pixels_done = slice.first_pixel + slice.pixel_count;
        if (pass_pixels_done == pixel_count) {
            samples_done += slice.sample_count;
            pass_pixels_done = 0;
        }
    }
    return steps;
}

// What is wrong with the steps as a way to do the work, or "nothing".
std::string fault(const std::vector<Step> &steps, std::uint32_t pixel_count, std::uint32_t samples,
                  const pt::ScheduleLimits &limits) {
    std::uint64_t samples_done = 0;
    std::uint32_t next_pixel = 0;
    double largest = std::max<double>(limits.first_slice_paths, limits.pixel_granularity) / 2.0;
    for (std::size_t i = 0; i < steps.size(); ++i) {
        const pt::Slice &slice = steps[i].slice;
        const std::string where = " in slice " + std::to_string(i);
        const std::uint32_t end = slice.first_pixel + slice.pixel_count;
        if (slice.pixel_count == 0 || slice.sample_count == 0)
            return "no work" + where;
        if (slice.first_pixel != next_pixel || end > pixel_count)
            return "pixels left out or done twice" + where;
        if (slice.whole && (slice.first_pixel != 0 || slice.pixel_count != pixel_count))
            return "a whole slice without all pixels" + where;
        if (!slice.whole && slice.sample_count != 1)
            return "a split pass of several samples" + where;
        if (slice.sample_count > limits.max_samples)
            return "too many samples" + where;
        if (slice.pixel_count % limits.pixel_granularity != 0 && end != pixel_count)
            return "a ragged range" + where;
        if (paths_of(slice) > 2.0 * largest)
            return "growth beyond twofold" + where;
        largest = std::max(largest, paths_of(slice));
        next_pixel = end == pixel_count ? 0 : end;
        samples_done += end == pixel_count ? slice.sample_count : 0;
    }
    if (next_pixel != 0)
        return "a pass is not complete";
    return samples_done == samples ? "nothing" : "samples left out or done twice";
}

pt::ScheduleLimits usual_limits() {
    return {0.05, 16384.0, 1024, 64};
}

struct DeviceCase {
    const char *name;
    std::uint32_t pixel_count;
    std::uint32_t samples;
    Device device;
    // Share of the slices after warm-up, cut short by no limit, that must be within a factor of 2 of the target.
    double on_target;
};

void PrintTo(const DeviceCase &test_case, std::ostream *out) {
    *out << test_case.name;
}

class SimulatedDevice : public testing::TestWithParam<DeviceCase> {};

TEST_P(SimulatedDevice, DoesAllWorkOnceWithinLimits) {
    const DeviceCase &test_case = GetParam();
    const std::vector<Step> steps =
        simulate(test_case.pixel_count, test_case.samples, usual_limits(), test_case.device);
    EXPECT_EQ(fault(steps, test_case.pixel_count, test_case.samples, usual_limits()), "nothing");
}

// Doubling from 2^14 paths to the largest slice of the cases takes less than 20 slices.
constexpr std::size_t warm_up = 20;

double share_on_target(const std::vector<Step> &steps, const pt::ScheduleLimits &limits) {
    int judged = 0;
    int good = 0;
    for (std::size_t i = warm_up; i + 1 < steps.size(); ++i) { // the last one is what is left
        ++judged;
        good += steps[i].seconds <= 2.0 * limits.target_seconds && steps[i].seconds >= 0.5 * limits.target_seconds;
    }
    return judged > 0 ? static_cast<double>(good) / judged : 1.0;
}

TEST_P(SimulatedDevice, ApproachesTheTarget) {
    const DeviceCase &test_case = GetParam();
    const std::vector<Step> steps =
        simulate(test_case.pixel_count, test_case.samples, usual_limits(), test_case.device);
    ASSERT_GT(steps.size(), warm_up + 1) << "nothing to judge";
    EXPECT_GE(share_on_target(steps, usual_limits()), test_case.on_target);
}

constexpr std::uint32_t full_hd = 1920 * 1080;

INSTANTIATE_TEST_SUITE_P(
    Schedule, SimulatedDevice,
    testing::Values(DeviceCase{"WholeSamples", 200 * 75, 20000, constant_device(1e8), 1.0},
                    DeviceCase{"SplitPasses", full_hd, 20, constant_device(1e6), 1.0},
                    DeviceCase{"RangesAndWholeSamplesByTurns", 50000, 300, constant_device(1.01e6), 1.0},
                    DeviceCase{"FastGpu", full_hd, 5000, constant_device(3e9), 1.0},
                    // Only the slice in which the speed falls is too long.
                    DeviceCase{"SpeedFallsToATenth", full_hd, 400, throttled_device(1e8, 2e8), 0.99},
                    DeviceCase{"SpeedFallsFromWholeToSplit", full_hd, 100, throttled_device(1e8, 5e7), 0.99},
                    // The time of a slice is off by its own noise and by that of the slice that sized it: a factor of
                    // 2 is passed with the probability (1 - ln 2 / (2 ln 1.5))^2 = 0.02.
                    DeviceCase{"NoisyClock", 200 * 75, 200000, noisy_device(1e8), 0.95}),
    [](const auto &instance) { return std::string(instance.param.name); });

// Not even a workgroup is done in the target time: then it is one workgroup.
TEST(Schedule, VerySlowDevicesGetOneWorkgroupATime) {
    const std::vector<Step> steps = simulate(1000, 30, usual_limits(), constant_device(1000.0));
    EXPECT_EQ(fault(steps, 1000, 30, usual_limits()), "nothing");
    for (std::size_t i = 30; i + 1 < steps.size(); ++i)
        ASSERT_LE(steps[i].slice.pixel_count, 64U);
}

// Faster than the largest slice allowed: then it is the largest slice.
TEST(Schedule, VeryFastDevicesGetTheLargestSlice) {
    const std::vector<Step> steps = simulate(1000, 1U << 20, usual_limits(), constant_device(1e15));
    EXPECT_EQ(fault(steps, 1000, 1U << 20, usual_limits()), "nothing");
    for (std::size_t i = warm_up; i + 1 < steps.size(); ++i)
        ASSERT_EQ(steps[i].slice.sample_count, usual_limits().max_samples);
}

TEST(Schedule, ImagesOfAnySizeAreDoneOnce) {
    for (const std::uint32_t pixel_count : {1U, 63U, 64U, 65U, 127U, 4097U, 16383U, 16384U, 16385U, 1000003U})
        for (const double speed : {2e3, 1e5, 1e7}) {
            SCOPED_TRACE(testing::Message() << pixel_count << " pixels, " << speed << " paths a second");
            const std::vector<Step> steps = simulate(pixel_count, 7, usual_limits(), constant_device(speed));
            EXPECT_EQ(fault(steps, pixel_count, 7, usual_limits()), "nothing");
        }
}

TEST(Schedule, HoldsTheLargestImageAndSampleCount) {
    constexpr std::uint32_t most = UINT32_MAX;
    pt::ScheduleLimits limits = usual_limits();
    limits.max_samples = most;
    const std::vector<Step> large = simulate(most, 3, limits, constant_device(1e15));
    EXPECT_EQ(fault(large, most, 3, limits), "nothing");
    const std::vector<Step> long_run = simulate(1, most, limits, constant_device(1e15));
    EXPECT_EQ(fault(long_run, 1, most, limits), "nothing");
}

// Drivers stop kernels after so many loop trips.
TEST(Schedule, KeepsTheSampleLimitOnFastDevices) {
    pt::ScheduleLimits limits = usual_limits();
    limits.max_samples = 3;
    const std::vector<Step> steps = simulate(64, 1000, limits, constant_device(1e12));
    EXPECT_EQ(fault(steps, 64, 1000, limits), "nothing");
    EXPECT_EQ(steps.front().slice.sample_count, 3U);
}

TEST(Schedule, AFirstGuessBelowAWorkgroupIsAWorkgroup) {
    pt::ScheduleLimits limits = usual_limits();
    limits.first_slice_paths = 0.25;
    const pt::Slice slice = pt::Schedule(1000, limits).next(1, 0);
    EXPECT_EQ(slice.pixel_count, 64U);
    EXPECT_FALSE(slice.whole);
}

TEST(Schedule, ASplitPassEndsAsOne) {
    pt::Schedule schedule(100000, usual_limits());
    const pt::Slice first = schedule.next(50, 0);
    ASSERT_FALSE(first.whole);
    for (int i = 0; i < 30; ++i)
        schedule.measured({0, 100000, 1024, true}, 1e-9); // by now everything would fit into a slice
    const pt::Slice rest = schedule.next(50, first.pixel_count);
    EXPECT_FALSE(rest.whole);
    EXPECT_EQ(rest.sample_count, 1U);
    EXPECT_EQ(rest.first_pixel, first.pixel_count);
    EXPECT_EQ(rest.first_pixel + rest.pixel_count, 100000U);
    EXPECT_TRUE(schedule.next(49, 0).whole);
}

// A cancelled call leaves a split pass, which the next call goes on with, whatever it asks for.
TEST(Schedule, GoesOnWithinAPass) {
    pt::Schedule schedule(100000, usual_limits());
    const pt::Slice slice = schedule.next(1, 64 * 1000);
    EXPECT_EQ(slice.first_pixel, 64U * 1000);
    EXPECT_FALSE(slice.whole);
}

// Ranges of a pass are about equal: no small one at its end.
TEST(Schedule, RangesAreLargerThanHalfOfTheBudget) {
    pt::Schedule schedule(64 * 257, usual_limits()); // a workgroup more than the budget
    EXPECT_EQ(schedule.next(1, 0).pixel_count, 64U * 129);
    EXPECT_EQ(schedule.next(1, 64 * 129).pixel_count, 64U * 128);
}

double budget_after(double seconds) {
    pt::ScheduleLimits limits = usual_limits();
    limits.max_samples = 1U << 30;
    pt::Schedule schedule(64, limits);
    const pt::Slice slice = schedule.next(UINT32_MAX, 0);
    EXPECT_EQ(paths_of(slice), 16384.0);
    schedule.measured(slice, seconds);
    return paths_of(schedule.next(UINT32_MAX, 0));
}

TEST(Schedule, LearnsFromASliceOfFullSizeAtOnce) {
    EXPECT_EQ(budget_after(0.05), 16384.0);
    EXPECT_EQ(budget_after(0.1), 8192.0);
    EXPECT_EQ(budget_after(0.8), 1024.0);
    EXPECT_EQ(budget_after(0.04), 16384.0 * 1.25);
}

TEST(Schedule, GrowsAtMostTwofold) {
    EXPECT_EQ(budget_after(0.025), 32768.0);
    EXPECT_EQ(budget_after(0.001), 32768.0);
    EXPECT_EQ(budget_after(1e-300), 32768.0);
    EXPECT_EQ(budget_after(0.0), 32768.0);
}

TEST(Schedule, ShrinksToAWorkgroupAtMost) {
    EXPECT_EQ(budget_after(1e9), 64.0);
    EXPECT_EQ(budget_after(std::numeric_limits<double>::infinity()), 64.0);
}

TEST(Schedule, PassesOverImpossibleTimes) {
    EXPECT_EQ(budget_after(-1.0), 16384.0);
    EXPECT_EQ(budget_after(-std::numeric_limits<double>::infinity()), 16384.0);
    EXPECT_EQ(budget_after(std::numeric_limits<double>::quiet_NaN()), 16384.0);
}

// A slice of one workgroup is all overhead; it must not be taken for the speed of the device, which would be 78 times
// lower.
TEST(Schedule, SmallSlicesChangeLittle) {
    pt::ScheduleLimits limits = usual_limits();
    limits.max_samples = 1U << 30;
    limits.first_slice_paths = 5e6;
    pt::Schedule schedule(64, limits);
    schedule.measured({0, 64, 1, true}, overhead);
    EXPECT_NEAR(paths_of(schedule.next(UINT32_MAX, 0)), 5e6, 0.01 * 5e6);
}

TEST(Schedule, WhatWasExpectedTeachesNothing) {
    pt::ScheduleLimits limits = usual_limits();
    limits.max_samples = 1U << 30;
    pt::Schedule schedule(64, limits);
    EXPECT_EQ(schedule.expected_seconds({0, 64, 128, true}), 0.025) << "half of the budget";
    for (const std::uint32_t samples : {1U, 128U, 256U})
        schedule.measured({0, 64, samples, true}, schedule.expected_seconds({0, 64, samples, true}));
    EXPECT_EQ(schedule.budget(), 16384.0);
}

// Negative controls: the judges see each fault.
TEST(ScheduleJudge, SeesFaults) {
    pt::ScheduleLimits limits = usual_limits();
    limits.max_samples = 4;
    const auto judged = [&](std::vector<pt::Slice> slices) {
        std::vector<Step> steps;
        for (const pt::Slice &slice : slices)
            steps.push_back({slice, 0.05});
        return fault(steps, 1000, 4, limits);
    };
    EXPECT_EQ(judged({{0, 1000, 4, true}}), "nothing");
    EXPECT_EQ(judged({{0, 640, 1, false}, {640, 360, 1, false}, {0, 1000, 3, true}}), "nothing");
    EXPECT_EQ(judged({{0, 1000, 3, true}}), "samples left out or done twice");
    EXPECT_EQ(judged({{0, 1000, 4, true}, {0, 1000, 1, true}}), "samples left out or done twice");
    EXPECT_EQ(judged({{0, 1000, 3, true}, {0, 640, 1, false}}), "a pass is not complete");
    EXPECT_EQ(judged({{0, 640, 1, false}, {704, 296, 1, false}}), "pixels left out or done twice in slice 1");
    EXPECT_EQ(judged({{0, 640, 1, false}, {576, 424, 1, false}}), "pixels left out or done twice in slice 1");
    EXPECT_EQ(judged({{0, 640, 1, false}, {640, 361, 1, false}}), "pixels left out or done twice in slice 1");
    EXPECT_EQ(judged({{0, 640, 1, false}, {640, 360, 2, false}}), "a split pass of several samples in slice 1");
    EXPECT_EQ(judged({{0, 641, 1, false}, {641, 359, 1, false}}), "a ragged range in slice 0");
    EXPECT_EQ(judged({{0, 640, 4, true}}), "a whole slice without all pixels in slice 0");
    EXPECT_EQ(judged({{0, 1000, 5, true}}), "too many samples in slice 0");
    EXPECT_EQ(judged({{0, 1000, 0, true}}), "no work in slice 0");
    limits.first_slice_paths = 999.0;
    EXPECT_EQ(judged({{0, 1000, 4, true}}), "growth beyond twofold in slice 0");
    limits.first_slice_paths = 1000.0;
    EXPECT_EQ(judged({{0, 1000, 1, true}, {0, 1000, 3, true}}), "growth beyond twofold in slice 1");
}

// A schedule that never learns misses the target.
TEST(ScheduleJudge, SeesSlicesOffTarget) {
    const std::vector<Step> late(100, Step{{0, 1000, 1, true}, 0.11});
    EXPECT_EQ(share_on_target(late, usual_limits()), 0.0);
    const std::vector<Step> early(100, Step{{0, 1000, 1, true}, 0.02});
    EXPECT_EQ(share_on_target(early, usual_limits()), 0.0);
}

} // namespace
