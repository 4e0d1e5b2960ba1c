#include "lib/film/error_region.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace pt {

namespace {

// Values of which one asks for the mean of the others.
class ValueSet {
public:
    void add(double value) {
        sum_ += value;
        count_ += 1.0;
        second_ = std::max(second_, std::min(value, largest_));
        largest_ = std::max(largest_, value);
    }

    double mean_besides(double value) const { return std::max(sum_ - value, 0.0) / std::max(count_ - 1.0, 1.0); }

    // The largest of the others may be a firefly too.
    double mean_besides_and_without_largest(double value) const {
        const double largest_of_others = value < largest_ ? largest_ : second_;
        return std::max(sum_ - value - largest_of_others, 0.0) / std::max(count_ - 2.0, 1.0);
    }

private:
    double sum_ = 0.0;
    double count_ = 0.0;
    double largest_ = 0.0;
    double second_ = 0.0;
};

// The mean about a pixel, of its tile or, where one pixel of that has most of the light, of its region.
double level_about(double mean, const ValueSet &tile, const ValueSet &region) {
    const double level = tile.mean_besides_and_without_largest(mean);
    return level >= 0.5 * tile.mean_besides(mean) ? level : region.mean_besides_and_without_largest(mean);
}

struct Neighbourhood {
    double median;
    double largest;
};

// Three values in ascending order.
struct Sorted {
    double low;
    double middle;
    double high;
};

Sorted sorted(double a, double b, double c) {
    const double low = std::min(a, b);
    const double high = std::max(a, b);
    return {std::min(low, c), std::max(low, std::min(high, c)), std::max(high, c)};
}

// Of nine values in three rows, each sorted: the median is the middle one of the largest of the low values, the middle
// one of the middle values and the smallest of the high values (Paeth 1990, Median finding on a 3 x 3 grid).
Neighbourhood neighbourhood_of_rows(const Sorted &a, const Sorted &b, const Sorted &c) {
    return {sorted(sorted(a.low, b.low, c.low).high, sorted(a.middle, b.middle, c.middle).middle,
                   sorted(a.high, b.high, c.high).low)
                .middle,
            std::max({a.high, b.high, c.high})};
}

// Where the region ends beside the pixel. Of an even number the median is the lower of the two in the middle, so that
// of two pixels the brighter does not stand for itself; a pixel alone has no neighbours.
Neighbourhood neighbourhood_at_edge(const RegionChannel &channel, std::size_t x, std::size_t y) {
    std::array<double, 9> values{};
    std::size_t count = 0;
    for (std::size_t row = y - (y > 0 ? 1 : 0); row <= y + 1 && row < channel.height; ++row)
        for (std::size_t column = x - (x > 0 ? 1 : 0); column <= x + 1 && column < channel.width; ++column)
            values[count++] = channel.mean[row * channel.width + column];
    if (count == 1)
        return {0.0, values[0]};
    const auto end = values.begin() + static_cast<std::ptrdiff_t>(count);
    const auto middle = values.begin() + static_cast<std::ptrdiff_t>((count - 1) / 2);
    std::nth_element(values.begin(), middle, end);
    return {*middle, *std::max_element(middle, end)};
}

// Of the pixels of the region that touch a pixel, and itself.
Neighbourhood neighbourhood(const RegionChannel &channel, std::size_t x, std::size_t y) {
    if (x == 0 || y == 0 || x + 1 == channel.width || y + 1 == channel.height)
        return neighbourhood_at_edge(channel, x, y);
    const auto row = [&](std::size_t index) {
        const double *const values = &channel.mean[index * channel.width + x];
        return sorted(values[-1], values[0], values[1]);
    };
    return neighbourhood_of_rows(row(y - 1), row(y), row(y + 1));
}

// Of the pixels of the channel that touch a pixel, and itself.
double largest_beside(const RegionChannel &channel, std::size_t x, std::size_t y) {
    double largest = 0.0;
    for (std::size_t row = y - (y > 0 ? 1 : 0); row <= y + 1 && row < channel.height; ++row)
        for (std::size_t column = x - (x > 0 ? 1 : 0); column <= x + 1 && column < channel.width; ++column)
            largest = std::max(largest, channel.mean[row * channel.width + column]);
    return largest;
}

// The square of the pixel's limit that divides the square of its error must not come from a bright sample that made
// that error, so it is no more than the squares of what is known without it: the darker part's mean, what most
// neighbours show, and the mean about it; but no more than that of the pixel's own mean either.
//
// Where that is the own mean after all, since it is bright around, but a part with half of the samples or more knows
// little of it, the pixel lies at an edge: a share p of its samples is bright, M each, and one of N was so far, hence
// the mean T = M / N and a square error of about T^2. If any p was as likely before, it is y / N with the density y
// e^-y now, and the limit is M p. The expectation of T^2 / (M^2 p^2 + k^2), with k^2 what the darker part knows and the
// offset, is the integral of y e^-y / (y^2 + k^2 / T^2): ln(T / k), less a constant of about 1 that depends on what was
// likely before; without it the stated error was right in the scenes that it was calibrated with.
double relative_square(double standard_error, double mean, double lesser, double around) {
    const double limit = std::min(squared(mean), squared(std::max(lesser, around))) + relative_offset;
    const double known = squared(lesser) + relative_offset;
    // With a share f of the samples in the darker part, standard_error / (mean - lesser) = sqrt(f / (1 - f)),
    // which is 1 for halves, but for the roundings of the three to float.
    const bool most_are_dark = standard_error >= 0.99 * (mean - lesser);
    const bool bright_around = around >= mean;
    constexpr double e_squared = 7.39; // where the logarithm passes 1
    const bool at_edge = most_are_dark && bright_around && limit > e_squared * known;
    return squared(standard_error) / limit * (at_edge ? 0.5 * std::log(limit / known) : 1.0);
}

// Light of the mean M in a pixel beside may be in a share p of this one's samples too. None of N had it if their mean
// is below M / N. With any p up to 1 / N as likely, and the square error p M^2 / N, the expectation of
// p M^2 / N / (T^2 + p^2 M^2 + offset) is the integral over p from 0 to 1 / N, times the chance of about 1 / N that p
// is that small: ln((T^2 + M^2 / N^2 + offset) / (T^2 + offset)) / 2N.
double unseen_square(double mean, double largest_beside, double sample_count) {
    const double brightest = largest_beside / sample_count;
    if (mean >= brightest)
        return 0.0;
    return 0.5 / sample_count * std::log1p(squared(brightest) / (squared(mean) + relative_offset));
}

} // namespace

std::vector<ValueError> value_errors(const RegionChannel &channel, std::span<const double> sample_counts) {
    const std::size_t tile_columns = (channel.width + tile_size - 1) / tile_size;
    const std::size_t tile_rows = (channel.height + tile_size - 1) / tile_size;
    const auto tile_of = [&](std::size_t x, std::size_t y) { return y / tile_size * tile_columns + x / tile_size; };
    ValueSet region;
    std::vector<ValueSet> tiles(tile_columns * tile_rows);
    for (std::size_t y = 0; y < channel.height; ++y)
        for (std::size_t x = 0; x < channel.width; ++x) {
            const double mean = channel.mean[y * channel.width + x];
            region.add(mean);
            tiles[tile_of(x, y)].add(mean);
        }

    std::vector<ValueError> errors;
    errors.reserve(channel.mean.size());
    for (std::size_t y = 0; y < channel.height; ++y)
        for (std::size_t x = 0; x < channel.width; ++x) {
            const std::size_t i = y * channel.width + x;
            const double mean = channel.mean[i];
            const double square = squared(channel.standard_error[i]);
            const auto [median, largest] = neighbourhood(channel, x, y);
            const ValueSet &tile = tiles[tile_of(x, y)];
            const double around = std::max(median, level_about(mean, tile, region));
            errors.push_back({square, relative_square(channel.standard_error[i], mean, channel.lesser[i], around),
                              unseen_square(mean, largest, sample_counts[tile_of(x, y)])});
        }
    return errors;
}

double own_square(const RegionChannel &tile, double sample_count) {
    ValueSet values;
    for (const double mean : tile.mean)
        values.add(mean);
    double sum = 0.0;
    for (std::size_t y = 0; y < tile.height; ++y)
        for (std::size_t x = 0; x < tile.width; ++x) {
            const std::size_t i = y * tile.width + x;
            const double mean = tile.mean[i];
            sum += relative_square(tile.standard_error[i], mean, tile.lesser[i],
                                   values.mean_besides_and_without_largest(mean)) +
                   unseen_square(mean, largest_beside(tile, x, y), sample_count);
        }
    return sum;
}

} // namespace pt
