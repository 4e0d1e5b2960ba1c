#pragma once

#include "lib/film/error_estimate.h"
#include "lib/film/tile_grid.h"

#include <cstddef>
#include <cstdint>
#include <vector>

namespace pt {

struct ImageValues {
    std::vector<float> mean;
    std::vector<float> standard_error;
    std::vector<float> lesser;
};

inline void add_tiles(ErrorEstimator &estimator, std::size_t width, const ImageValues &image,
                      std::uint64_t sample_count) {
    const TileGrid grid{static_cast<std::uint32_t>(width), static_cast<std::uint32_t>(image.mean.size() / 3 / width)};
    for (std::size_t i = 0; i < grid.count(); ++i) {
        const Rectangle pixels = grid.pixels(i);
        TileValues tile{
            .width = pixels.width, .height = pixels.height, .sample_count = static_cast<double>(sample_count)};
        for (std::size_t y = 0; y < tile.height; ++y)
            for (std::size_t x = 0; x < tile.width; ++x)
                for (std::size_t channel = 0; channel < 3; ++channel) {
                    const std::size_t from = 3 * ((pixels.y + y) * width + pixels.x + x) + channel;
                    tile.pixels[y * tile_size + x][channel] = {image.mean[from], image.standard_error[from],
                                                               image.lesser[from]};
                }
        estimator.add(tile_errors(tile));
    }
}

} // namespace pt
