#include "lib/denoise/tiles.h"

namespace pt {

namespace {

void spread(std::vector<double> &numbers, std::size_t first, std::size_t count, std::size_t step) {
    double before = numbers[first];
    for (std::size_t i = 0; i < count; ++i) {
        double &here = numbers[first + i * step];
        const double after = i + 1 < count ? numbers[first + (i + 1) * step] : here;
        const double mean = 0.25 * (before + after) + 0.5 * here;
        before = here;
        here = mean;
    }
}

} // namespace

void spread(Tiles &tiles) {
    for (std::size_t row = 0; row < tiles.rows; ++row)
        spread(tiles.numbers, row * tiles.columns, tiles.columns, 1);
    for (std::size_t column = 0; column < tiles.columns; ++column)
        spread(tiles.numbers, column, tiles.rows, tiles.columns);
}

Place::Place(std::size_t pixel, std::size_t count) {
    const double position = (static_cast<double>(pixel) + 0.5) / Tiles::width - 0.5; // in tile centers
    const double inside = std::clamp(position, 0.0, static_cast<double>(count - 1));
    first = static_cast<std::size_t>(inside);
    second = std::min(first + 1, count - 1);
    share = inside - static_cast<double>(first);
}

double at(const Tiles &tiles, const Place &x, const Place &y) {
    const auto in_row = [&](std::size_t row) {
        const double *const numbers = &tiles.numbers[row * tiles.columns];
        return std::lerp(numbers[x.first], numbers[x.second], x.share);
    };
    return std::lerp(in_row(y.first), in_row(y.second), y.share);
}

} // namespace pt
