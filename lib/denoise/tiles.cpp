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

} // namespace pt
