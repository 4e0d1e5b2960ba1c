#include "lib/denoise/combination.h"

#include "lib/denoise/doubts.h"
#include "lib/denoise/limits.h"
#include "lib/denoise/terms.h"
#include "lib/denoise/tiles.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace pt {

namespace {

constexpr double few_tiles = 8.0;
constexpr double normal_90 = 1.28; // 90% quantile of the standard normal distribution

struct Squares {
    explicit Squares(const Halves &halves) :
        noise(halves),
        free_products(halves),
        limit_products(halves),
        first_moves(halves),
        second_moves(halves) {}

    void add(std::size_t tile, const Terms &terms, double weight) {
        noise.numbers[tile] += weight * squared(terms.noise + terms.noise_change());
        free_products.numbers[tile] += weight * terms.free_product();
        limit_products.numbers[tile] += weight * terms.limit_product();
        first_moves.numbers[tile] += std::sqrt(weight) * terms.first_move;
        second_moves.numbers[tile] += std::sqrt(weight) * terms.second_move;
    }

    Tiles noise;
    Tiles free_products;
    Tiles limit_products;
    Tiles first_moves;
    Tiles second_moves;
};

Tiles by_tile(Squares squares, const Tiles &value_counts) {
    Tiles products = squares.first_moves;
    for (std::size_t tile = 0; tile < products.numbers.size(); ++tile)
        products.numbers[tile] *= squares.second_moves.numbers[tile] / value_counts.numbers[tile];
    spread(squares.free_products);
    spread(squares.limit_products);
    spread(products);
    for (std::size_t tile = 0; tile < products.numbers.size(); ++tile)
        squares.noise.numbers[tile] +=
            faults(squares.free_products.numbers[tile], squares.limit_products.numbers[tile], products.numbers[tile]);
    return std::move(squares.noise);
}

// Kish's effective sample size.
double effective_count(const Tiles &sums) {
    double sum = 0.0;
    double squares = 0.0;
    for (const double number : sums.numbers) {
        sum += number;
        squares += squared(number);
    }
    return sum > 0.0 ? squared(sum) / squares : 0.0;
}

// The variance between tiles includes differences of content, so the interval tends to be too wide.
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
    const auto root = [&](double deviations) {
        return std::sqrt(std::max(std::max(mean, 0.0) + deviations * deviation, 0.0));
    };
    const double factor = uncertain ? uncertain_factor : 1.0;
    return {root(normal_90), root(-normal_95) / factor, root(normal_95) * factor};
}

ErrorEstimate error_of(const Halves &halves) {
    Squares squares(halves);
    Squares relative_squares(halves);
    Tiles value_counts(halves);
    for_each_pixel(halves, [&](std::size_t tile, std::size_t x, std::size_t y) {
        for (std::size_t channel = 0; channel < channel_count; ++channel) {
            const Terms terms = terms_at(halves, x, y, channel);
            squares.add(tile, terms, 1.0);
            relative_squares.add(tile, terms, terms.weight);
        }
        value_counts.numbers[tile] += channel_count;
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

std::vector<float> differences(const float *filtered, const float *raw, std::size_t count) {
    std::vector<float> moves(count);
    std::transform(filtered, filtered + count, raw, moves.begin(), [](float to, float from) { return to - from; });
    return moves;
}

} // namespace

ErrorEstimate combine(const pt_denoise_info &info, const float *first_filtered, const float *second_filtered) {
    const std::size_t value_count = std::size_t{info.width} * info.height * channel_count;
    Halves halves{.width = info.width,
                  .height = info.height,
                  .first = info.first,
                  .second = info.second,
                  .first_filtered = first_filtered,
                  .second_filtered = second_filtered,
                  .first_move = differences(first_filtered, info.first, value_count),
                  .second_move = differences(second_filtered, info.second, value_count)};
    limit_moves(halves);
    take_back_doubtful_moves(halves);
    keep_mean(halves);
    for (std::size_t i = 0; i < value_count; ++i)
        info.denoised[i] = static_cast<float>(0.5 * (double{info.first[i]} + info.second[i]) +
                                              0.5 * (double{halves.first_move[i]} + halves.second_move[i]));
    return error_of(halves);
}

} // namespace pt
