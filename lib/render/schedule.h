// Sizes submissions to equal times. RenderDevice asks how much, runs it, and reports the time.
#pragma once

#include <cstddef>
#include <cstdint>

namespace pt {

struct ScheduleLimits {
    double target_seconds = 0.05;       // a submission's target
    double first_slice_paths = 16384.0; // within the target on slow devices
    std::uint32_t max_samples = 1;      // per pixel and submission
};

class Schedule {
public:
    explicit Schedule(const ScheduleLimits &limits);

    // Samples of each of `tile_count` tiles in one submission, from 1 to `most`.
    std::uint64_t samples(std::size_t tile_count, std::uint64_t most) const;

    // Number of remaining tiles in the next submission, with these samples each; at least 1.
    std::size_t tiles(std::size_t left, std::uint64_t sample_count) const;

    // Paths that should take the time of one submission.
    double budget() const { return budget_; }

    double expected_seconds(double paths) const;

    // Learns from a measured time; ignores negative ones and NaN.
    void measured(double paths, double seconds);

private:
    ScheduleLimits limits_;
    double budget_;
};

// Counts every tile as whole.
double paths_of(std::size_t tile_count, std::uint64_t sample_count);

} // namespace pt
