#include "lib/denoise/terms.h"

#include "lib/denoise/surroundings.h"
#include "lib/film/tile_errors.h"

namespace pt {

namespace {

float mean_at(const Halves &halves, std::size_t index) {
    return 0.5F * (halves.first[index] + halves.second[index]);
}

// Returns the weight of a squared error in the relative error. The square of the true value is estimated by D(A) D(B),
// because the square of S would include noise. If a filter spreads a lamp over dark pixels, this estimate is too large
// and would hide the error. So the estimate is at most the square of the raw pixel or, if larger, of four times the
// median of 3x3 pixels. pixel_error.h explains the logarithm at edges.
double relative_weight(const Halves &halves, std::size_t x, std::size_t y, std::size_t channel) {
    constexpr double most_above_median = 4.0;
    const std::size_t index = halves.index(x, y, channel);
    const double first = halves.first[index];
    const double second = halves.second[index];
    const double mean = 0.5 * (first + second);
    const double product = std::max(double{halves.first_filtered[index]} * halves.second_filtered[index], 0.0);
    double most_square = squared(mean);
    if (mean < 0.0 || product > most_square)
        most_square = squared(std::max(mean, most_above_median * median_about(halves, x, y, channel, &mean_at)));
    gpu::Limit limit{};
    limit.square = std::min(product, most_square) + relative_offset;
    limit.known = squared(std::min(first, second)) + relative_offset;
    limit.light_beyond = limit.square - gpu::E_SQUARED * limit.known;
    return gpu::relative_square(1.0, limit);
}

} // namespace

Terms terms_at(const Halves &halves, std::size_t x, std::size_t y, std::size_t channel) {
    const std::size_t index = halves.index(x, y, channel);
    return {.noise = 0.5 * (double{halves.first[index]} - halves.second[index]),
            .first_move = halves.first_move[index],
            .second_move = halves.second_move[index],
            .first_free = double{halves.first_filtered[index]} - halves.first[index],
            .second_free = double{halves.second_filtered[index]} - halves.second[index],
            .weight = relative_weight(halves, x, y, channel)};
}

} // namespace pt
