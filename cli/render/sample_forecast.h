// Owns the guess of how many samples a target error takes, for the progress that is shown on the way.
// Called by render_samples and render_report.
#pragma once

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>

namespace cli {

// Samples with which pt.h first knows the error of an image.
inline constexpr std::uint32_t first_look = 16;

// From then on it looks at the error every eighth of a power of two; so often the guess can be mended.
inline std::uint32_t samples_to_next_look(std::uint32_t sample_count) {
    if (sample_count < first_look) {
        return first_look - sample_count;
    }
    const std::uint32_t step = std::bit_floor(sample_count) / 8;
    return step - sample_count % step;
}

// In all, where `sample_count` samples have the error `error`, which may be infinite. Of independent samples, the error
// falls with the root of their number: stratified samples need fewer, and the guess falls as they come. More than the
// samples done at the next look, so that no share of it is 1 before the target is reached.
inline std::uint32_t forecast_sample_count(std::uint32_t sample_count, double error, double target_error,
                                           std::uint32_t most) {
    const double ratio = error / target_error;
    const double guess = sample_count * ratio * ratio;
    const double least = static_cast<double>(sample_count) + samples_to_next_look(sample_count) + 1.0;
    return static_cast<std::uint32_t>(std::min(std::max(std::ceil(guess), least), static_cast<double>(most)));
}

} // namespace cli
