// What the regions of an image say of its error, where a test knows what its pixels show.
#pragma once

#include "lib/film/error_estimate.h"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace pt {

// R, G, B of each pixel.
struct ImageValues {
    std::vector<float> mean;
    std::vector<float> standard_error;
    std::vector<float> lesser; // of the means of the film's parts
};

inline std::vector<float> planes_of(const std::vector<float> &values) {
    std::vector<float> planes;
    for (std::size_t channel = 0; channel < 3; ++channel)
        for (std::size_t i = channel; i < values.size(); i += 3)
            planes.push_back(values[i]);
    return planes;
}

// After so many samples in every pixel.
inline void add_regions(ErrorEstimator &estimator, std::size_t width, const ImageValues &image,
                        std::uint64_t sample_count) {
    const std::vector<float> mean = planes_of(image.mean);
    const std::vector<float> standard_error = planes_of(image.standard_error);
    const std::vector<float> lesser = planes_of(image.lesser);
    const std::size_t count = mean.size() / 3;
    for (std::size_t y = 0; y < count / width; y += region_size)
        for (std::size_t x = 0; x < width; x += region_size) {
            const std::size_t first = y * width + x;
            RegionPixels region{{std::min(region_size, width - x), std::min(region_size, count / width - y), width,
                                 count, &mean[first], &standard_error[first], &lesser[first]},
                                0,
                                {}};
            region.sample_counts.fill(static_cast<double>(sample_count));
            estimator.add(region_errors(region));
        }
}

} // namespace pt
