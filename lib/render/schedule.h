// Sizes submissions to take equal times.
#pragma once

#include <cstddef>
#include <cstdint>

namespace pt {

struct ScheduleLimits {
    double target_seconds = 0.05;
    double first_slice_paths = 16384.0;
    std::uint32_t max_samples = 1;
};

class Schedule {
public:
    explicit Schedule(const ScheduleLimits &limits);

    std::uint64_t samples(std::size_t tile_count, std::uint64_t most) const;

    // How many of the remaining tiles the next submission takes, at least 1.
    std::size_t tiles(std::size_t left, std::uint64_t sample_count) const;

    // Number of paths that should take the time of one submission.
    double budget() const { return budget_; }

    double expected_seconds(double paths) const;

    void measured(double paths, double seconds);

private:
    ScheduleLimits limits_;
    double budget_;
};

// Counts incomplete tiles as complete.
double paths_of(std::size_t tile_count, std::uint64_t sample_count);

} // namespace pt
