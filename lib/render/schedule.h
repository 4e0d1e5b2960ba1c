// How much work goes into one submission, so that each takes about the same time. It knows neither a clock nor a
// device: RenderDevice asks how much, runs it, and reports how long it took.
#pragma once

#include <cstddef>
#include <cstdint>

namespace pt {

struct ScheduleLimits {
    double target_seconds = 0.05;       // aim for the time of a submission
    double first_slice_paths = 16384.0; // paths that even a slow device follows in that time
    std::uint32_t max_samples = 1;      // per pixel and submission
};

class Schedule {
public:
    explicit Schedule(const ScheduleLimits &limits);

    // How many samples each of this many tiles may take in one submission: from 1 to most.
    std::uint64_t samples(std::size_t tile_count, std::uint64_t most) const;

    // How many of the remaining tiles go into the next submission if each takes this many samples: at least 1.
    std::size_t tiles(std::size_t left, std::uint64_t sample_count) const;

    // How many paths should take the time of one submission.
    double budget() const { return budget_; }

    double expected_seconds(double paths) const;

    // Learns from the time that paths took. Times that are negative or NaN are ignored.
    void measured(double paths, double seconds);

private:
    ScheduleLimits limits_;
    double budget_; // paths expected to take target_seconds
};

// Paths of this many tiles with so many samples each, counting every tile as whole.
double paths_of(std::size_t tile_count, std::uint64_t sample_count);

} // namespace pt
