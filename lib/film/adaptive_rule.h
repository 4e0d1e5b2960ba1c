// Decides which tiles of a film take more samples. A tile has 16, 32, 64, ... samples per pixel. It doubles them while
// the expected gain per added sample exceeds a bound, which falls from round to round until the image's error is small
// enough. A tile's samples are then in proportion to the root of its error square after equal times. Equal errors
// everywhere would take as many samples as no adaptation.
//
// A round leaves each tile at the first level whose gain is at most the bound, however it got there.
#pragma once

#include "lib/film/error_estimate.h"
#include "lib/film/film_header.h"
#include "lib/film/tile_samples.h"

#include <cstdint>
#include <functional>
#include <optional>
#include <span>
#include <utility>
#include <vector>

namespace pt {

// Levels are 16 times powers of two.
std::uint64_t next_level(std::uint64_t sample_count);
bool is_level(std::uint64_t sample_count);

// By tile: the expected decrease of the square error by doubling the samples, over the number of samples added; 0 if
// unknown. squares: expected sums of squared relative errors.
std::vector<double> tile_gains(const TileSamples &samples, std::span<const double> squares);

// Whether a film with equal samples everywhere gains by treating tiles differently.
bool are_worth_telling_apart(std::span<const double> gains);

// Tiles that double their samples in this round. All must be at a level. lamps: by tile, samples that meet the lamps
// smaller than a pixel.
std::vector<std::uint32_t> wanting_tiles(const TileSamples &samples, std::span<const double> gains,
                                         std::span<const std::uint64_t> lamps, const AdaptiveRound &round);

// The first round of a film that needs samples for lamps alone.
AdaptiveRound round_of_lamps(std::span<const double> gains);

// The next round in which a tile wants samples. excess: (error / target)^2 > 1; infinite if the error is unknown.
// sees_too_little: much of the error is light that no sample has met (PT_UNCERTAIN_UNSEEN). Then the tiles with the
// fewest samples take more, and excess counts only what tiles themselves show, so it may be 1 or less.
AdaptiveRound round_after(const AdaptiveRound &round, const TileSamples &samples, std::span<const double> squares,
                          std::span<const double> gains, double excess, bool sees_too_little);

// tiles: ascending. goal: samples that a tile is to have.
struct TileStep {
    std::vector<std::uint32_t> tiles;
    std::function<std::uint64_t(std::uint32_t)> goal;
};

// Each call takes time.
struct FilmLooks {
    std::function<ErrorEstimate()> error;
    std::function<std::vector<double>()> squares; // each tile's own_square() (tile_errors.h)

    std::function<std::vector<std::uint64_t>()> samples_for_lamps; // lamps of wanting_tiles()
};

// Maximum samples of a pixel.
struct MostSamples {
    std::uint64_t most;  // now
    std::uint64_t limit; // ever; not less
};

// The rule from one error check to the next. While tiles have equal samples, checks come at fixed counts. Later a tile
// decides by its own sums and the round alone, and a round ends when no tile needs samples. So interruptions and limits
// do not change a film's samples.
class AdaptivePlan {
public:
    AdaptivePlan(double target_error, const MostSamples &counts, FilmLooks film) :
        target_error_(target_error),
        counts_(counts),
        film_(std::move(film)) {}

    // Nothing if the film has the target error and has met the lamps in view; no tiles if none may take more. The goals
    // refer to `samples`, which must outlive them. Begins the next round when one is over.
    std::optional<TileStep> next(const TileSamples &samples, AdaptiveRound &round) const;

private:
    std::optional<TileStep> next_together(const TileSamples &samples, AdaptiveRound &round) const;
    std::optional<TileStep> next_apart(const TileSamples &samples, AdaptiveRound &round) const;
    std::optional<TileStep> next_on_target(const TileSamples &samples, AdaptiveRound &round) const;
    std::vector<std::uint32_t> unfinished_tiles(const TileSamples &samples) const;
    TileStep to_next_level(const TileSamples &samples, std::vector<std::uint32_t> tiles) const;

    double target_error_;
    MostSamples counts_;
    FilmLooks film_;
};

} // namespace pt
