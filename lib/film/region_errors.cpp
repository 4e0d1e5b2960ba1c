#include "lib/film/region_errors.h"

#include <algorithm>

namespace pt {

namespace {

void add_tile(ErrorSquares &to, double square, double value_count) {
    to.sum += square;
    to.of_tiles += squared(square);
    to.times_tile_sizes += square * value_count;
}

RegionChannel channel_of(const RegionPixels &region, std::size_t channel) {
    RegionChannel values{region.width, region.height, {}, {}, {}};
    const auto take = [&](std::vector<double> &to, const float *from) {
        to.resize(region.width * region.height);
        for (std::size_t y = 0; y < region.height; ++y)
            for (std::size_t x = 0; x < region.width; ++x)
                to[y * region.width + x] = static_cast<double>(from[y * region.row_values + 3 * x + channel]);
    };
    take(values.mean, region.radiance);
    take(values.standard_error, region.standard_error);
    take(values.lesser, region.lesser);
    return values;
}

// Of each pixel, summed over channels.
std::vector<ValueError> pixel_errors(const RegionPixels &region) {
    std::vector<ValueError> pixels(region.width * region.height);
    for (std::size_t channel = 0; channel < 3; ++channel) {
        const std::vector<ValueError> values = value_errors(channel_of(region, channel), region.sample_counts);
        for (std::size_t i = 0; i < pixels.size(); ++i) {
            pixels[i].square += values[i].square;
            pixels[i].relative_square += values[i].relative_square;
            pixels[i].unseen += values[i].unseen;
        }
    }
    return pixels;
}

} // namespace

RegionErrors region_errors(const RegionPixels &region) {
    const std::vector<ValueError> pixels = pixel_errors(region);
    RegionErrors errors;
    errors.rejected = region.rejected;
    for (std::size_t top = 0; top < region.height; top += tile_size)
        for (std::size_t first = 0; first < region.width; first += tile_size) {
            const std::size_t bottom = std::min(top + tile_size, region.height);
            const std::size_t last = std::min(first + tile_size, region.width);
            const auto value_count = static_cast<double>(3 * (bottom - top) * (last - first));
            double square = 0.0;
            double relative_square = 0.0;
            for (std::size_t y = top; y < bottom; ++y)
                for (std::size_t x = first; x < last; ++x) {
                    const ValueError &pixel = pixels[y * region.width + x];
                    square += pixel.square;
                    relative_square += pixel.relative_square;
                    errors.square.of_pixels += squared(pixel.square);
                    errors.relative_square.of_pixels += squared(pixel.relative_square);
                    errors.unseen += pixel.unseen;
                }
            errors.value_count += value_count;
            errors.squares_of_tile_sizes += squared(value_count);
            add_tile(errors.square, square, value_count);
            add_tile(errors.relative_square, relative_square, value_count);
        }
    return errors;
}

double own_square_of(const RegionPixels &tile) {
    double sum = 0.0;
    for (std::size_t channel = 0; channel < 3; ++channel)
        sum += own_square(channel_of(tile, channel), tile.sample_counts.front());
    return sum;
}

} // namespace pt
