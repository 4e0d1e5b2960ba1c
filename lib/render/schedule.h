// Cuts rendering into submissions to the device that each take about the same time. No clock and no device in here:
// Renderer asks for the next slice, runs it, and reports how long it took.
#pragma once

#include <cstdint>

namespace pt {

// The part of the work that goes into one submission.
struct Slice {
    std::uint32_t first_pixel;
    std::uint32_t pixel_count;
    std::uint32_t sample_count;
    bool whole; // true: whole samples of all pixels; false: a range of one pass of one sample over all pixels
};

struct ScheduleLimits {
    double target_seconds = 0.05;        // aim for the time of a submission
    double first_slice_paths = 16384.0;  // paths that even a slow device follows in that time
    std::uint32_t max_samples = 1;       // per pixel and submission
    std::uint32_t pixel_granularity = 1; // a range of a split pass is a multiple of it, or ends with the image
};

class Schedule {
public:
    Schedule(std::uint32_t pixel_count, const ScheduleLimits &limits);

    // What to do next, when remaining_samples >= 1 samples are still to be started or finished, and in the first of
    // them pass_pixels_done pixels are done already (0 unless a split pass is under way). A split pass ends as one:
    // it goes on from there, whatever the budget has become.
    Slice next(std::uint32_t remaining_samples, std::uint32_t pass_pixels_done) const;

    // Paths that are expected to take the time of a submission.
    double budget() const { return budget_; }

    double expected_seconds(const Slice &slice) const;

    // Learns from the time a slice took. Times that are negative or NaN are ignored.
    void measured(const Slice &slice, double seconds);

private:
    Slice rest_of_pass(std::uint32_t pass_pixels_done) const;

    std::uint32_t pixel_count_;
    ScheduleLimits limits_;
    double budget_; // paths expected to take target_seconds
};

} // namespace pt
