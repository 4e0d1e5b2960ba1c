// Guesses how many samples a target error takes, for the progress that is shown on the way.
#pragma once

#include <pt/stats.h>

#include <algorithm>
#include <cmath>
#include <cstdint>

namespace cli {

// In all, where `sample_count` samples have the error `error`, which may be infinite. Of independent samples, the error
// falls with the root of their number: stratified samples need fewer, and the guess falls as they come. More than the
// samples done at the next look, so that no share of it is 1 before the target is reached.
inline std::uint32_t forecast_sample_count(std::uint32_t sample_count, double error, double target_error,
                                           std::uint32_t most) {
    const double ratio = error / target_error;
    const double guess = sample_count * ratio * ratio;
    const double least = pt_next_check(sample_count) + 1.0;
    return static_cast<std::uint32_t>(std::min(std::max(std::ceil(guess), least), static_cast<double>(most)));
}

} // namespace cli
