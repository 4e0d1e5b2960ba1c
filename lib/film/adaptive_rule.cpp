#include "lib/film/adaptive_rule.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <map>

namespace pt {

namespace {

constexpr std::uint64_t first_level = 16; // of fewer samples the difference of the film's parts says too little

// Every tile holds a fourth of the mean or more: what its samples have not met yet they can only meet by being taken. On
// scenes where tiles differ 2 to 3 times in what they need this costs a fiftieth of what uneven films gain.
constexpr std::uint64_t floor_share = 4;

double bound_of(std::int32_t round) {
    return std::exp2(-0.5 * round);
}

// What as many samples again are expected to gain, half of the square, for each sample they cost; but for that half.
// Nothing if the square is unknown.
double gain_of(const TileSamples &samples, std::span<const double> squares, std::size_t tile) {
    const auto pixels = static_cast<double>(samples.grid().pixels(tile).pixel_count());
    const auto count = static_cast<double>(samples.of(tile).count());
    return std::isfinite(squares[tile]) ? squares[tile] / (pixels * count) : 0.0;
}

// The last round whose bound a gain > 0 does not exceed.
std::int32_t last_content_round(double gain) {
    auto round = static_cast<std::int32_t>(std::floor(-2.0 * std::log2(gain)));
    while (gain > bound_of(round))
        --round;
    while (gain <= bound_of(round + 1))
        ++round;
    return round;
}

// The squares of tiles by the last round that asks nothing of them.
using SquaresByRound = std::map<std::int32_t, double>;

// The sum that is expected in a round. Where the square falls as 1 / N, what a tile gains falls to a fourth as its samples
// double: four rounds.
double expected_sum(const SquaresByRound &squares, std::int32_t round) {
    double sum = 0.0;
    for (const auto &[content, square] : squares)
        sum += std::ldexp(square, -std::max((round - content + 3) / 4, 0));
    return sum;
}

} // namespace

std::uint64_t next_level(std::uint64_t sample_count) {
    return std::max(first_level, 2 * std::bit_floor(sample_count));
}

bool is_level(std::uint64_t sample_count) {
    return sample_count >= first_level && std::has_single_bit(sample_count);
}

std::vector<std::uint32_t> unfinished_tiles(const TileSamples &samples) {
    std::vector<std::uint32_t> tiles;
    for (std::uint32_t tile = 0; tile < samples.grid().count(); ++tile)
        if (!is_level(samples.of(tile).count()))
            tiles.push_back(tile);
    return tiles;
}

std::vector<std::uint32_t> wanting_tiles(const TileSamples &samples, std::span<const double> squares,
                                         const AdaptiveRound &round) {
    std::vector<std::uint32_t> tiles;
    if (round.number == AdaptiveRound::none)
        return tiles;
    const double bound = bound_of(round.number);
    for (std::uint32_t tile = 0; tile < samples.grid().count(); ++tile)
        if (samples.of(tile).count() < round.floor || gain_of(samples, squares, tile) > bound)
            tiles.push_back(tile);
    return tiles;
}

// The further the target, the more rounds are left out: half of those that it is expected to take. With stratified samples
// squares fall faster than expected, so that the target is hardly ever left behind by much.
AdaptiveRound round_after(const AdaptiveRound &round, const TileSamples &samples, std::span<const double> squares,
                          double excess, bool sees_too_little) {
    const std::uint64_t pixels = std::uint64_t{samples.grid().width} * samples.grid().height;
    const std::uint64_t share = samples.total() / pixels / floor_share;
    AdaptiveRound next{round.number, std::max(round.floor, std::bit_floor(share))};
    if (sees_too_little)
        next.floor = std::max(next.floor, next_level(samples.least()));
    SquaresByRound by_round;
    for (std::size_t tile = 0; tile < samples.grid().count(); ++tile)
        if (const double gain = gain_of(samples, squares, tile); gain > 0.0)
            by_round[last_content_round(gain)] += squares[tile];
    if (by_round.empty()) {
        next.floor = std::max(next.floor, next_level(samples.least()));
        next.number = std::max(next.number, 0);
        return next;
    }
    const std::int32_t first = std::max(round.number, by_round.begin()->first) + 1;
    std::int32_t last = first;
    for (const double aim = expected_sum(by_round, first - 1) / excess;
         aim > 0.0 && expected_sum(by_round, last) > aim;)
        ++last;
    next.number = first + (last - first) / 2;
    return next;
}

} // namespace pt
