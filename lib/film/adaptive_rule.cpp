#include "lib/film/adaptive_rule.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <map>
#include <vector>

namespace pt {

namespace {

constexpr std::uint64_t first_level = 16; // of fewer samples the difference of the film's parts says too little

// Every tile holds a fourth of the mean or more: what its samples have not met yet they can only meet by being taken. On
// scenes where tiles differ 2 to 3 times in what they need this costs a fiftieth of what uneven films gain.
constexpr std::uint64_t floor_share = 4;

constexpr double root_of_half = 0.70710678118654752440;

double bound_of(std::int32_t round) {
    const std::int32_t halves = round >> 1; // rounded down
    return std::ldexp((round & 1) != 0 ? root_of_half : 1.0, -halves);
}

// What as many samples again are expected to gain, half of the square, for each sample they cost; but for that half.
// Nothing if the square is unknown.
class Gains {
public:
    Gains(const TileSamples &samples, std::span<const double> squares) : samples_(samples), squares_(squares) {
        for (const SampleSet &set : samples.sets())
            counts_.push_back(static_cast<double>(set.count()));
    }

    double of(std::size_t tile) const {
        const auto pixels = static_cast<double>(samples_.grid().pixels(tile).pixel_count());
        const double square = squares_[tile];
        return std::isfinite(square) ? square / (pixels * counts_[samples_.set_of(tile)]) : 0.0;
    }

private:
    const TileSamples &samples_;
    std::span<const double> squares_;
    std::vector<double> counts_; // of the sets
};

// The last round whose bound a gain > 0 does not exceed: -2 log2(gain), rounded down.
std::int32_t last_content_round(double gain) {
    int exponent = 0;
    const double fraction = std::frexp(gain, &exponent); // in [1/2, 1)
    return -2 * exponent + (fraction <= 0.5 ? 2 : fraction <= root_of_half ? 1 : 0);
}

// The squares of tiles by the last round that asks nothing of them.
using SquaresByRound = std::map<std::int32_t, double>;

SquaresByRound by_content_round(const TileSamples &samples, std::span<const double> squares) {
    SquaresByRound sums;
    auto last = sums.end();
    const Gains gains(samples, squares);
    for (std::size_t tile = 0; tile < samples.grid().count(); ++tile) {
        const double gain = gains.of(tile);
        if (!(gain > 0.0))
            continue;
        const std::int32_t round = last_content_round(gain);
        if (last == sums.end() || last->first != round) // neighbours are alike
            last = sums.try_emplace(round, 0.0).first;
        last->second += squares[tile];
    }
    return sums;
}

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
    const Gains gains(samples, squares);
    for (std::uint32_t tile = 0; tile < samples.grid().count(); ++tile)
        if (samples.of(tile).count() < round.floor || gains.of(tile) > bound)
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
    const SquaresByRound by_round = by_content_round(samples, squares);
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
