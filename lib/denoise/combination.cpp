#include "lib/denoise/combination.h"

#include "lib/film/tile_errors.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

namespace pt {

namespace {

constexpr std::size_t channel_count = 3;
constexpr std::size_t tile_width = 8; // pixels: with those about it, hundreds of values
constexpr double few_tiles =
    8.0; // an estimate from fewer is uncertain, as one from as few pixels is (error_estimate.cpp)
constexpr double normal_90 = 1.28; // for the normal distribution, 90% lie below so many standard deviations

// A, B, D(A) and D(B), each with width times height times 3 values.
struct FilteredHalves {
    std::size_t width;
    std::size_t height;
    const float *first;
    const float *second;
    const float *first_filtered;
    const float *second_filtered;
};

// The median of M over the 3 x 3 pixels about one, repeated at the image's edges.
double median_about(const FilteredHalves &halves, std::size_t x, std::size_t y, std::size_t channel) {
    std::array<double, 9> values{};
    for (std::size_t i = 0; i < values.size(); ++i) {
        const std::size_t column = std::clamp<std::size_t>(x + i % 3, 1, halves.width) - 1;
        const std::size_t row = std::clamp<std::size_t>(y + i / 3, 1, halves.height) - 1;
        const std::size_t index = (row * halves.width + column) * channel_count + channel;
        values[i] = 0.5 * (double{halves.first[index]} + halves.second[index]);
    }
    std::nth_element(values.begin(), values.begin() + 4, values.end());
    return values[4];
}

// The terms of (1) in one value.
struct Terms {
    double mean;           // M
    double difference;     // d
    double noise;          // s
    double filtered_noise; // f
    double first_fault;    // A - D(A)
    double second_fault;   // B - D(B)
    double weight;         // of relative squares
};

// D(A) D(B), whose factors are independent, stands for the square of the limit: the square of F would have the filter's
// noise in it, and weigh dark places too little. But a filter that spreads a lamp over dark pixels must not hide there,
// so it counts no more than the raw pixel, or four times what is about it. What one half did not meet at the edge of
// something bright is weighed as a film's edges are (pixel_error.h): the less is known of its limit, the more.
Terms terms_at(const FilteredHalves &halves, std::size_t x, std::size_t y, std::size_t channel) {
    constexpr double most_above_median = 4.0;
    const std::size_t index = (y * halves.width + x) * channel_count + channel;
    const double first = halves.first[index];
    const double second = halves.second[index];
    const double first_filtered = halves.first_filtered[index];
    const double second_filtered = halves.second_filtered[index];
    const double mean = 0.5 * (first + second);
    const double filtered_square = std::max(first_filtered * second_filtered, 0.0);
    double most_square = squared(mean);
    if (mean < 0.0 || filtered_square > most_square) // else the median, which takes most of the time, changes nothing
        most_square = squared(std::max(mean, most_above_median * median_about(halves, x, y, channel)));
    gpu::Limit limit{};
    limit.square = std::min(filtered_square, most_square) + relative_offset;
    limit.known = squared(std::min(first, second)) + relative_offset;
    limit.light_beyond = limit.square - gpu::E_SQUARED * limit.known;
    return {.mean = mean,
            .difference = 0.5 * (first_filtered + second_filtered) - mean,
            .noise = 0.5 * (first - second),
            .filtered_noise = 0.5 * (first_filtered - second_filtered),
            .first_fault = first - first_filtered,
            .second_fault = second - second_filtered,
            .weight = gpu::relative_square(1.0, limit)};
}

// A number for each tile, row by row.
struct Tiles {
    explicit Tiles(const FilteredHalves &halves) :
        columns((halves.width + tile_width - 1) / tile_width),
        rows((halves.height + tile_width - 1) / tile_width),
        numbers(columns * rows) {}

    std::size_t columns;
    std::size_t rows;
    std::vector<double> numbers;
};

// Means over tiles and those about them, with half of the weight for each step away; an outermost tile stands for those
// beyond the edge as well, so that the sum of all stays. Along one axis, of `count` tiles that are `step` apart.
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

void spread(Tiles &tiles) {
    for (std::size_t row = 0; row < tiles.rows; ++row)
        spread(tiles.numbers, row * tiles.columns, tiles.columns, 1);
    for (std::size_t column = 0; column < tiles.columns; ++column)
        spread(tiles.numbers, column, tiles.rows, tiles.columns);
}

// Between two tiles, and how near to the second.
struct Place {
    std::size_t first;
    std::size_t second;
    double share;

    Place(std::size_t pixel, std::size_t count) {
        const double position = (static_cast<double>(pixel) + 0.5) / tile_width - 0.5; // 0: in the first one's middle
        const double inside = std::clamp(position, 0.0, static_cast<double>(count - 1));
        first = static_cast<std::size_t>(inside);
        second = std::min(first + 1, count - 1);
        share = inside - static_cast<double>(first);
    }
};

// Linear between the middles of tiles, so that there are no seams.
double at(const Tiles &tiles, const Place &x, const Place &y) {
    const auto in_row = [&](std::size_t row) {
        const double *const numbers = &tiles.numbers[row * tiles.columns];
        return std::lerp(numbers[x.first], numbers[x.second], x.share);
    };
    return std::lerp(in_row(y.first), in_row(y.second), y.share);
}

// Calls visit(tile, channel, x, y) for all values, tile by tile.
template <typename Visit>
void for_each_value(const FilteredHalves &halves, const Tiles &tiles, Visit &&visit) {
    for (std::size_t tile = 0; tile < tiles.numbers.size(); ++tile) {
        const std::size_t left = tile % tiles.columns * tile_width;
        const std::size_t top = tile / tiles.columns * tile_width;
        for (std::size_t y = top; y < std::min(top + tile_width, halves.height); ++y)
            for (std::size_t x = left; x < std::min(left + tile_width, halves.width); ++x)
                for (std::size_t channel = 0; channel < channel_count; ++channel)
                    visit(tile, channel, x, y);
    }
}

// The t of each tile.
Tiles best_shares(const FilteredHalves &halves) {
    Tiles shares(halves);
    Tiles differences(halves);
    for_each_value(halves, shares, [&](std::size_t tile, std::size_t channel, std::size_t x, std::size_t y) {
        const Terms terms = terms_at(halves, x, y, channel);
        shares.numbers[tile] += terms.weight * terms.noise * (terms.noise - terms.filtered_noise);
        differences.numbers[tile] += terms.weight * squared(terms.difference);
    });
    spread(shares);
    spread(differences);
    for (std::size_t tile = 0; tile < shares.numbers.size(); ++tile) {
        const double whole = differences.numbers[tile];
        shares.numbers[tile] = whole > 0.0 ? std::clamp(shares.numbers[tile] / whole, 0.0, 1.0) : 0.0;
    }
    return shares;
}

// Squares of errors, each times a weight, summed by tile.
struct Squares {
    explicit Squares(const FilteredHalves &halves) :
        noise(halves),
        faults(halves),
        first_faults(halves),
        second_faults(halves) {}

    void add(std::size_t tile, const Terms &terms, double share, double weight) {
        const double first = std::sqrt(weight) * share * terms.first_fault;
        const double second = std::sqrt(weight) * share * terms.second_fault;
        noise.numbers[tile] += weight * squared(std::lerp(terms.noise, terms.filtered_noise, share));
        faults.numbers[tile] += first * second;
        first_faults.numbers[tile] += first;
        second_faults.numbers[tile] += second;
    }

    Tiles noise;
    Tiles faults; // products of those of the halves
    Tiles first_faults;
    Tiles second_faults;
};

// The expected squares of the errors of each tile.
Tiles by_tile(Squares squares, const Tiles &value_counts) {
    Tiles products = squares.first_faults; // of sums
    for (std::size_t tile = 0; tile < products.numbers.size(); ++tile)
        products.numbers[tile] *= squares.second_faults.numbers[tile] / value_counts.numbers[tile];
    spread(squares.faults);
    spread(products);
    for (std::size_t tile = 0; tile < products.numbers.size(); ++tile)
        squares.noise.numbers[tile] += std::max({squares.faults.numbers[tile], products.numbers[tile], 0.0});
    return std::move(squares.noise);
}

// How many equal tiles would have the same ratio of their squares to their sum.
double effective_count(const Tiles &sums) {
    double sum = 0.0;
    double squares = 0.0;
    for (const double number : sums.numbers) {
        sum += number;
        squares += squared(number);
    }
    return sum > 0.0 ? squared(sum) / squares : 0.0;
}

// The root of the mean of squares, from their sums by tile. Its bounds come from how tiles differ: by noise, and also
// by what they show, which makes the bounds too wide rather than too narrow.
Interval root_mean(const Tiles &sums, const Tiles &value_counts, bool uncertain) {
    double sum = 0.0;
    double count = 0.0;
    for (std::size_t tile = 0; tile < sums.numbers.size(); ++tile) {
        sum += sums.numbers[tile];
        count += value_counts.numbers[tile];
    }
    const double mean = sum / count;
    double variance = 0.0;
    for (std::size_t tile = 0; tile < sums.numbers.size(); ++tile)
        variance += squared(sums.numbers[tile] - mean * value_counts.numbers[tile]);
    const double deviation = std::sqrt(variance) / count;
    const auto root = [&](double deviations) { return std::sqrt(std::max(mean, 0.0) + deviations * deviation); };
    return {root(normal_90), std::sqrt(std::max(mean - normal_95 * deviation, 0.0)),
            root(normal_95) * (uncertain ? uncertain_factor : 1.0)};
}

} // namespace

ErrorEstimate combine(const pt_denoise_info &info, const float *first_filtered, const float *second_filtered) {
    const FilteredHalves halves{info.width, info.height, info.first, info.second, first_filtered, second_filtered};
    const Tiles shares = best_shares(halves);
    Squares squares(halves);
    Squares relative_squares(halves);
    Tiles value_counts(halves);
    for_each_value(halves, shares, [&](std::size_t tile, std::size_t channel, std::size_t x, std::size_t y) {
        const double share = at(shares, Place(x, shares.columns), Place(y, shares.rows));
        const Terms terms = terms_at(halves, x, y, channel);
        info.denoised[(y * halves.width + x) * channel_count + channel] =
            static_cast<float>(terms.mean + share * terms.difference);
        squares.add(tile, terms, share, 1.0);
        relative_squares.add(tile, terms, share, terms.weight);
        value_counts.numbers[tile] += 1.0;
    });
    const auto error = [&](Squares &of, std::uint32_t bit) {
        const Tiles sums = by_tile(std::move(of), value_counts);
        const bool uncertain = effective_count(sums) < few_tiles;
        return std::pair(root_mean(sums, value_counts, uncertain), uncertain ? bit : 0);
    };
    const auto [rmse, rmse_bit] = error(squares, PT_UNCERTAIN_RMSE);
    const auto [relative_rmse, relative_bit] = error(relative_squares, PT_UNCERTAIN_RELATIVE_RMSE);
    return {rmse, relative_rmse, rmse_bit | relative_bit};
}

} // namespace pt
