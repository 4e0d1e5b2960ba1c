#include "lib/film/adaptive_plan.h"

#include "lib/film/adaptive_rule.h"
#include "lib/film/error_estimate.h"
#include "lib/film/tile_errors.h"

#include <algorithm>
#include <utility>

namespace pt {

namespace {

// Until the error that tiles know by themselves is within this factor of the target, the image's own error is not
// looked at. That one knows more and has bounds; in most scenes of cli/scenes it was 0.93 to 1.12 times as large, in
// the others up to 5 times.
constexpr double near_target = 1.2;

} // namespace

// Tiles that were interrupted on their way to a level are completed first, as far as the limit allows.
std::optional<TileStep> AdaptivePlan::next(const TileSamples &samples, AdaptiveRound &round) const {
    if (round.number == AdaptiveRound::none && samples.most() <= next_check(samples.least()))
        return next_together(samples, round);
    if (TileStep step = to_next_level(samples, unfinished_tiles(samples)); !step.tiles.empty())
        return step;
    return next_apart(samples, round);
}

// While all tiles are treated alike, the error is checked as for even samples, and before that, at each level, whether
// it pays to tell tiles apart. Some tiles may be on the way from one of these counts to the next.
std::optional<TileStep> AdaptivePlan::next_together(const TileSamples &samples, AdaptiveRound &round) const {
    const std::uint64_t count = samples.least();
    if (samples.even() && is_level(count) && are_worth_telling_apart(tile_gains(samples, squares_())))
        return next_apart(samples, round);
    if (samples.even() && is_check(count) && error_().relative_rmse.high <= target_error_)
        return std::nullopt;
    TileStep step;
    const std::uint64_t goal = std::min(next_check(count), most_);
    for (std::uint32_t tile = 0; tile < samples.grid().count(); ++tile)
        if (samples.of(tile).count() < goal)
            step.tiles.push_back(tile);
    step.goal = [goal](std::uint32_t) { return goal; };
    return step;
}

// If the limit on samples holds a tile back, at a level or on its way to one, the round stays, and the other tiles come
// to rest in it.
std::optional<TileStep> AdaptivePlan::next_apart(const TileSamples &samples, AdaptiveRound &round) const {
    const std::vector<double> squares = squares_();
    const std::vector<double> gains = tile_gains(samples, squares);
    std::vector<std::uint32_t> tiles = wanting_tiles(samples, gains, round);
    if (tiles.empty() && unfinished_tiles(samples).empty()) {
        const double of_tiles = error_of(samples, squares);
        double error = of_tiles;
        bool sees_too_little = false;
        if (of_tiles <= near_target * target_error_) {
            const ErrorEstimate of_image = error_();
            if (of_image.relative_rmse.high <= target_error_)
                return std::nullopt;
            sees_too_little = (of_image.uncertain & PT_UNCERTAIN_UNSEEN) != 0;
            error = sees_too_little ? of_tiles : of_image.relative_rmse.high;
        }
        round = round_after(round, samples, squares, gains, squared(error / target_error_), sees_too_little);
        tiles = wanting_tiles(samples, gains, round);
    }
    return to_next_level(samples, std::move(tiles));
}

TileStep AdaptivePlan::to_next_level(const TileSamples &samples, std::vector<std::uint32_t> tiles) const {
    std::erase_if(tiles, [&](std::uint32_t tile) { return samples.of(tile).count() >= most_; });
    return {std::move(tiles), [&samples, most = most_](std::uint32_t tile) {
                return std::min(next_level(samples.of(tile).count()), most);
            }};
}

} // namespace pt
