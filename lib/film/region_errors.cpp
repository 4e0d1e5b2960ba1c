#include "lib/film/region_errors.h"

#include <algorithm>

namespace pt {

namespace {

void add_tile(ErrorSquares &to, double square, double value_count) {
    to.sum += square;
    to.of_tiles += squared(square);
    to.times_tile_sizes += square * value_count;
}

} // namespace

RegionErrors region_errors(const RegionPixels &region) {
    const std::size_t width = region.values.width;
    const std::size_t height = region.values.height;
    PixelErrors pixels;
    find_pixel_errors(region.values, region.sample_counts, pixels);
    RegionErrors errors;
    errors.rejected = region.rejected;
    for (std::size_t top = 0; top < height; top += tile_size)
        for (std::size_t first = 0; first < width; first += tile_size) {
            const std::size_t bottom = std::min(top + tile_size, height);
            const std::size_t last = std::min(first + tile_size, width);
            const auto value_count = static_cast<double>(3 * (bottom - top) * (last - first));
            const auto add = [&](ErrorSquares &to, const PixelErrors::Numbers &of) {
                double sum = 0.0;
                for (std::size_t y = top; y < bottom; ++y)
                    for (std::size_t x = first; x < last; ++x) {
                        const double square = of[y * region_size + x];
                        sum += square;
                        to.of_pixels += squared(square);
                    }
                add_tile(to, sum, value_count);
            };
            add(errors.square, pixels.square);
            add(errors.relative_square, pixels.relative_square);
            add(errors.met_once, pixels.met_once);
            add(errors.as_lamps, pixels.as_lamps);
            for (std::size_t y = top; y < bottom; ++y)
                for (std::size_t x = first; x < last; ++x) {
                    errors.met_again += pixels.met_again[y * region_size + x];
                    errors.unseen += pixels.unseen[y * region_size + x];
                }
            errors.value_count += value_count;
            errors.squares_of_tile_sizes += squared(value_count);
        }
    return errors;
}

double own_square_of(const RegionPixels &tile) {
    return own_square(tile.values, tile.sample_counts.front());
}

} // namespace pt
