#include "lib/film/adaptive_rule.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <map>
#include <vector>

namespace pt {

namespace {

constexpr std::uint64_t first_level = 16;

// Each tile takes at least 1 / floor_share of the mean number of samples. With fewer, a tile might stop before any
// sample has hit its light.
constexpr std::uint64_t floor_share = 2;

constexpr double root_of_half = 0.70710678118654752440;

// 2^(-halves / 2), with the same bits on all machines.
double power_of_halves(std::int32_t halves) {
    const std::int32_t wholes = halves >> 1;
    return std::ldexp((halves & 1) != 0 ? root_of_half : 1.0, -wholes);
}

double bound_of(std::int32_t round) {
    return power_of_halves(round);
}

std::int32_t last_content_round(double gain) {
    int exponent = 0;
    const double fraction = std::frexp(gain, &exponent); // in [1/2, 1)
    return -2 * exponent + (fraction <= 0.5 ? 2 : fraction <= root_of_half ? 1 : 0);
}

// Sums of tiles' squared errors. The key is the last round in which the tiles need no samples.
using SquaresByRound = std::map<std::int32_t, double>;

SquaresByRound by_content_round(std::span<const double> gains, std::span<const double> squares) {
    SquaresByRound sums;
    auto last = sums.end();
    for (std::size_t tile = 0; tile < gains.size(); ++tile) {
        if (!(gains[tile] > 0.0))
            continue;
        const std::int32_t round = last_content_round(gains[tile]);
        if (last == sums.end() || last->first != round)
            last = sums.try_emplace(round, 0.0).first;
        last->second += squares[tile];
    }
    return sums;
}

// With stratified samples, squared errors fall about as N^-1.5. Doubling a tile's samples divides its squared error by
// 2^1.5 and its gain by 2^2.5. bound_of() falls by 2^2.5 in five rounds, so a tile doubles its samples once in five
// rounds.
double expected_sum(const SquaresByRound &squares, std::int32_t round) {
    constexpr std::int32_t rounds = 5; // rounds per doubling
    constexpr std::int32_t halves = 3; // the exponent 1.5 in halves
    double sum = 0.0;
    for (const auto &[content, square] : squares)
        sum += square * power_of_halves(halves * std::max((round - content + rounds - 1) / rounds, 0));
    return sum;
}

} // namespace

std::uint64_t next_level(std::uint64_t sample_count) {
    return std::max(first_level, 2 * std::bit_floor(sample_count));
}

bool is_level(std::uint64_t sample_count) {
    return sample_count >= first_level && std::has_single_bit(sample_count);
}

std::vector<double> tile_gains(const TileSamples &samples, std::span<const double> squares) {
    std::vector<double> shares; // by set
    for (const SampleSet &set : samples.sets())
        shares.push_back(1.0 / static_cast<double>(std::max<std::uint64_t>(set.count(), 1)));
    const TileGrid &grid = samples.grid();
    std::vector<double> gains;
    gains.reserve(squares.size());
    for (std::uint32_t y = 0; y < grid.height; y += gpu::TILE_SIZE)
        for (std::uint32_t x = 0; x < grid.width; x += gpu::TILE_SIZE) {
            const std::size_t tile = gains.size();
            const std::uint32_t pixels =
                std::min(gpu::TILE_SIZE, grid.width - x) * std::min(gpu::TILE_SIZE, grid.height - y);
            const double square = std::isfinite(squares[tile]) ? squares[tile] : 0.0;
            gains.push_back(square * shares[samples.set_of(tile)] / pixels);
        }
    return gains;
}

// Let v be the variances of tiles. If sample counts are proportional to sqrt(v), the same error takes mean(sqrt v)^2 /
// mean(v) times as many samples as with equal counts.
bool are_worth_telling_apart(std::span<const double> gains) {
    constexpr double least_ratio = 1.2;
    double sum = 0.0;
    double sum_of_roots = 0.0;
    for (const double gain : gains) {
        sum += gain;
        sum_of_roots += std::sqrt(gain);
    }
    return sum * static_cast<double>(gains.size()) > least_ratio * sum_of_roots * sum_of_roots;
}

std::vector<std::uint32_t> wanting_tiles(const TileSamples &samples, std::span<const double> gains,
                                         std::span<const std::uint64_t> lamps, const AdaptiveRound &round) {
    std::vector<std::uint32_t> tiles;
    if (round.number == AdaptiveRound::none)
        return tiles;
    std::vector<std::uint8_t> is_below_floor; // by set
    for (const SampleSet &set : samples.sets())
        is_below_floor.push_back(set.count() < round.floor ? 1 : 0);
    const double bound = bound_of(round.number);
    for (std::uint32_t tile = 0; tile < gains.size(); ++tile)
        if (gains[tile] > bound || is_below_floor[samples.set_of(tile)] != 0 || samples.of(tile).count() < lamps[tile])
            tiles.push_back(tile);
    return tiles;
}

AdaptiveRound round_of_lamps(std::span<const double> gains) {
    const double most = std::ranges::max(gains);
    return {most > 0.0 ? last_content_round(most) : 0, 0};
}

// Skips rounds that are not expected to reach the target, because the checks of each round cost time.
AdaptiveRound round_after(const AdaptiveRound &round, const TileSamples &samples, std::span<const double> squares,
                          std::span<const double> gains, double excess, bool sees_too_little) {
    const std::uint64_t pixels = std::uint64_t{samples.grid().width} * samples.grid().height;
    const std::uint64_t share = samples.total() / pixels / floor_share;
    AdaptiveRound next{round.number, std::max(round.floor, std::bit_floor(share))};
    if (sees_too_little)
        next.floor = std::max(next.floor, next_level(samples.least()));
    const SquaresByRound by_round = by_content_round(gains, squares);
    if (by_round.empty()) {
        next.floor = std::max(next.floor, next_level(samples.least()));
        next.number = std::max(next.number, 0);
        return next;
    }
    const std::int32_t content = std::max(round.number, by_round.begin()->first);
    // The rest of the error is light that no sample has hit. Only a larger minimum number of samples (floor) reduces
    // this error.
    if (sees_too_little && excess <= 1.0) {
        next.number = content;
        return next;
    }
    const std::int32_t first = content + 1;
    std::int32_t last = first;
    for (const double aim = expected_sum(by_round, first - 1) / excess;
         aim > 0.0 && expected_sum(by_round, last) > aim;)
        ++last;
    next.number = last;
    return next;
}

namespace {

// The image's error is slow to compute, so it is checked only within this factor of the target.
constexpr double near_target = 1.2;

double error_of(const TileSamples &samples, std::span<const double> squares) {
    double sum = 0.0;
    for (const double square : squares)
        sum += std::isfinite(square) ? square : 0.0;
    return std::sqrt(sum / (3.0 * samples.grid().width * samples.grid().height));
}

template <typename Holds>
std::vector<std::uint32_t> tiles_where(const TileSamples &samples, const Holds &holds) {
    std::vector<std::uint32_t> tiles;
    for (std::uint32_t tile = 0; tile < samples.grid().count(); ++tile)
        if (holds(tile, samples.of(tile).count()))
            tiles.push_back(tile);
    return tiles;
}

} // namespace

std::optional<TileStep> AdaptivePlan::next(const TileSamples &samples, AdaptiveRound &round) const {
    if (round.number == AdaptiveRound::none && samples.most() <= next_check(samples.least()))
        return next_together(samples, round);
    if (TileStep step = to_next_level(samples, unfinished_tiles(samples)); !step.tiles.empty())
        return step;
    return next_apart(samples, round);
}

std::optional<TileStep> AdaptivePlan::next_together(const TileSamples &samples, AdaptiveRound &round) const {
    const std::uint64_t count = samples.least();
    if (samples.even() && is_level(count) && are_worth_telling_apart(tile_gains(samples, film_.squares())))
        return next_apart(samples, round);
    if (samples.even() && is_check(count) && stopping_.is_reached(film_.error()))
        return next_on_target(samples, round);
    const std::uint64_t goal = std::min(next_check(count), counts_.most);
    return TileStep{tiles_where(samples, [=](std::uint32_t, std::uint64_t has) { return has < goal; }),
                    [goal](std::uint32_t) { return goal; }};
}

// If tiles need more samples than this call may take, the round goes on in the next call. If all tiles that want
// samples have reached counts_.limit, the tiles with the fewest samples take more.
std::optional<TileStep> AdaptivePlan::next_apart(const TileSamples &samples, AdaptiveRound &round) const {
    const std::vector<double> squares = film_.squares();
    const std::vector<double> gains = tile_gains(samples, squares);
    const std::vector<std::uint64_t> lamps = film_.samples_for_lamps();
    std::vector<std::uint32_t> tiles = wanting_tiles(samples, gains, lamps, round);
    const auto may_ever_take = [&](std::uint32_t tile) { return samples.of(tile).count() < counts_.limit; };
    if (std::ranges::any_of(tiles, may_ever_take) || !unfinished_tiles(samples).empty())
        return to_next_level(samples, std::move(tiles));
    const double of_tiles = error_of(samples, squares);
    double error = of_tiles;
    bool sees_too_little = false;
    if (stopping_.is_near(of_tiles, near_target) || !tiles.empty()) {
        const ErrorEstimate of_image = film_.error();
        if (stopping_.is_reached(of_image))
            return next_on_target(samples, round);
        sees_too_little = (of_image.uncertain & PT_UNCERTAIN_UNSEEN) != 0;
        error = sees_too_little ? of_tiles : of_image.relative_rmse.high;
    }
    if (tiles.empty()) {
        round = round_after(round, samples, squares, gains, squared(stopping_.excess(error)), sees_too_little);
        tiles = wanting_tiles(samples, gains, lamps, round);
    }
    if (std::ranges::none_of(tiles, may_ever_take))
        tiles = tiles_where(samples, [&](std::uint32_t, std::uint64_t has) { return has == samples.least(); });
    return to_next_level(samples, std::move(tiles));
}

std::optional<TileStep> AdaptivePlan::next_on_target(const TileSamples &samples, AdaptiveRound &round) const {
    const std::vector<std::uint64_t> lamps = film_.samples_for_lamps();
    std::vector<std::uint32_t> tiles =
        tiles_where(samples, [&](std::uint32_t tile, std::uint64_t has) { return has < lamps[tile]; });
    if (tiles.empty())
        return std::nullopt;
    if (round.number == AdaptiveRound::none)
        round = round_of_lamps(tile_gains(samples, film_.squares()));
    return to_next_level(samples, std::move(tiles));
}

std::vector<std::uint32_t> AdaptivePlan::unfinished_tiles(const TileSamples &samples) const {
    return tiles_where(samples,
                       [this](std::uint32_t, std::uint64_t has) { return !is_level(has) && has < counts_.limit; });
}

TileStep AdaptivePlan::to_next_level(const TileSamples &samples, std::vector<std::uint32_t> tiles) const {
    std::erase_if(tiles, [&](std::uint32_t tile) { return samples.of(tile).count() >= counts_.most; });
    return {std::move(tiles), [&samples, most = counts_.most](std::uint32_t tile) {
                return std::min(next_level(samples.of(tile).count()), most);
            }};
}

} // namespace pt
