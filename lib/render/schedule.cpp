// Sizes slices by the time of those before; see schedule.h.
#include "lib/render/schedule.h"

#include <algorithm>

namespace pt {

namespace {

// Of a slice over one that has been measured. A wrong guess must not run into the seconds after which drivers kill a
// submission.
constexpr double max_growth = 2.0;

double paths_of(const Slice &slice) {
    return static_cast<double>(slice.pixel_count) * slice.sample_count;
}

} // namespace

Schedule::Schedule(std::uint32_t pixel_count, const ScheduleLimits &limits) :
    pixel_count_(pixel_count),
    limits_(limits),
    budget_(std::max(limits.first_slice_paths, static_cast<double>(limits.pixel_granularity))) {}

Slice Schedule::next(std::uint32_t remaining_samples, std::uint32_t pass_pixels_done) const {
    if (pass_pixels_done > 0 || budget_ < pixel_count_)
        return rest_of_pass(pass_pixels_done);
    const std::uint32_t most_samples = std::min(remaining_samples, limits_.max_samples);
    const double affordable_samples = std::min<double>(budget_ / pixel_count_, most_samples);
    return {0, pixel_count_, static_cast<std::uint32_t>(affordable_samples), true};
}

// The next of as few equal ranges as the budget allows. Equal ones, since a small last one would waste the overhead
// of a submission: they are larger than half of the budget wherever one does not do.
Slice Schedule::rest_of_pass(std::uint32_t pass_pixels_done) const {
    const std::uint64_t left = pixel_count_ - pass_pixels_done;
    const std::uint64_t granularity = limits_.pixel_granularity;
    const std::uint64_t workgroups_left = (left + granularity - 1) / granularity;
    const double affordable = std::min<double>(budget_ / static_cast<double>(granularity), 0x1p32);
    const std::uint64_t most_workgroups = static_cast<std::uint64_t>(affordable);
    const std::uint64_t ranges = (workgroups_left + most_workgroups - 1) / most_workgroups;
    const std::uint64_t workgroups = (workgroups_left + ranges - 1) / ranges;
    return {pass_pixels_done, static_cast<std::uint32_t>(std::min(left, workgroups * granularity)), 1, false};
}

double Schedule::expected_seconds(const Slice &slice) const {
    return limits_.target_seconds * paths_of(slice) / budget_;
}

// A submission takes an overhead, about 0.1 ms, and a time per path, and one measurement cannot tell the two apart.
// So the excess over the expected time is treated as fixed overhead: exact for slices of the whole budget, while
// small slices, which are mostly overhead, change little. Repeated, it converges to the budget that takes
// target_seconds with its overhead: for overhead o and rate r the step is x -> x t / (o + x / r), whose only stable
// fixed point is x = r (t - o).
void Schedule::measured(const Slice &slice, double seconds) {
    if (!(seconds >= 0.0))
        return;
    const double budget_seconds = std::max(limits_.target_seconds + (seconds - expected_seconds(slice)), 0.0);
    const double learnt = budget_ * (limits_.target_seconds / budget_seconds);
    const double smallest = limits_.pixel_granularity;
    budget_ = std::max({smallest, std::min(learnt, budget_), std::min(learnt, max_growth * paths_of(slice))});
}

} // namespace pt
