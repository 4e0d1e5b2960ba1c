#include "lib/render/schedule.h"

#include "shaders/gpu_layout.h"

#include <algorithm>

namespace pt {

namespace {

// A submission may have at most this many times the paths of the largest measured one, because drivers have timeouts.
constexpr double max_growth = 2.0;

constexpr double paths_of_tile = gpu::WORKGROUP_SIZE;

} // namespace

double paths_of(std::size_t tile_count, std::uint64_t sample_count) {
    return paths_of_tile * static_cast<double>(tile_count) * static_cast<double>(sample_count);
}

Schedule::Schedule(const ScheduleLimits &limits) :
    limits_(limits),
    budget_(std::max(limits.first_slice_paths, paths_of_tile)) {}

std::uint64_t Schedule::samples(std::size_t tile_count, std::uint64_t most) const {
    const double affordable = std::min(budget_ / paths_of(tile_count, 1), 0x1p32);
    return std::clamp<std::uint64_t>(static_cast<std::uint64_t>(affordable), 1,
                                     std::min<std::uint64_t>(most, limits_.max_samples));
}

// Divides the tiles into the fewest submissions of equal size, because a small last one would be mostly overhead.
std::size_t Schedule::tiles(std::size_t left, std::uint64_t sample_count) const {
    const auto affordable = static_cast<std::size_t>(std::clamp(budget_ / paths_of(1, sample_count), 1.0, 0x1p32));
    const std::size_t shares = (left + affordable - 1) / affordable;
    return (left + shares - 1) / shares;
}

double Schedule::expected_seconds(double paths) const {
    return limits_.target_seconds * paths / budget_;
}

// A submission takes an overhead o, and a time 1 / r for each path. One measurement cannot separate both, so time
// beyond the expected time counts as overhead. The step x -> x t / (o + x / r) has the only stable fixed point x = r (t
// - o). At this point a submission takes t = target_seconds.
void Schedule::measured(double paths, double seconds) {
    if (!(seconds >= 0.0))
        return;
    const double budget_seconds = std::max(limits_.target_seconds + (seconds - expected_seconds(paths)), 0.0);
    const double learnt = budget_ * (limits_.target_seconds / budget_seconds);
    budget_ = std::max({paths_of_tile, std::min(learnt, budget_), std::min(learnt, max_growth * paths)});
}

} // namespace pt
