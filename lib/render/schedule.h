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

    // Returns the number of remaining tiles in the next submission, at least 1.
    std::size_t tiles(std::size_t left, std::uint64_t sample_count) const;

    double budget() const { return budget_; }

    double expected_seconds(double paths) const;

    // Ignores negative times and NaN.
    void measured(double paths, double seconds);

private:
    ScheduleLimits limits_;
    double budget_;
};

// Counts incomplete tiles as complete.
double paths_of(std::size_t tile_count, std::uint64_t sample_count);

} // namespace pt
