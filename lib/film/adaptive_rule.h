// Which tiles of a film take more samples. A tile holds 16, 32, 64, ... samples a pixel and takes as many again while
// what that is expected to gain, for each sample it costs, exceeds a bound; the bound falls from round to round, until
// the error of the image is small enough. So samples go where they gain most: equal errors everywhere would take as
// many as an even film (mean squares v after equal times), equal gains take them in proportion to the root of v.
//
// Pure arithmetic on what a film says. At the end of a round a tile holds the first of these numbers of samples at
// which it gains no more than the bound, whatever the order in which tiles came to it.
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

// The next level of a tile above this number of samples: 16 times a power of two.
std::uint64_t next_level(std::uint64_t sample_count);
bool is_level(std::uint64_t sample_count);

// For each tile, by how much doubling its samples is expected to lessen its square error, divided by the number of
// samples that this costs; 0 if that is unknown. squares: for each tile the expected sum of squared relative errors.
std::vector<double> tile_gains(const TileSamples &samples, std::span<const double> squares);

// Whether tiles of a film with the same samples everywhere differ so much that it pays to tell them apart.
bool are_worth_telling_apart(std::span<const double> gains);

// The tiles that are to double their samples in this round. All tiles are at a level. lamps: for each tile, with how
// many samples lamps in view are met that are smaller than a pixel.
std::vector<std::uint32_t> wanting_tiles(const TileSamples &samples, std::span<const double> gains,
                                         std::span<const std::uint64_t> lamps, const AdaptiveRound &round);

// The first round of a film that needs samples for lamps alone.
AdaptiveRound round_of_lamps(std::span<const double> gains);

// The next round, once no tile wants more samples in this one; in the next some tile does. excess: the square of (error
// of the image / target), > 1; infinite if the error is unknown. sees_too_little: much of the error is light that no
// sample has met (PT_UNCERTAIN_UNSEEN), perhaps of a neighbouring tile. Then the tiles with the fewest samples take
// more, and excess counts only what tiles themselves show, so it may be 1 or less.
AdaptiveRound round_after(const AdaptiveRound &round, const TileSamples &samples, std::span<const double> squares,
                          std::span<const double> gains, double excess, bool sees_too_little);

// Tiles that are to take samples, in ascending order, and the number of samples that each is to have then.
struct TileStep {
    std::vector<std::uint32_t> tiles;
    std::function<std::uint64_t(std::uint32_t)> goal;
};

// Looks at a film as it is at that moment, which takes time.
struct FilmLooks {
    std::function<ErrorEstimate()> error;
    std::function<std::vector<double>()> squares; // of tiles: their own_square() of tile_errors.h

    std::function<std::vector<std::uint64_t>()> samples_for_lamps; // of tiles, as in wanting_tiles()
};

// The most samples of any pixel.
struct MostSamples {
    std::uint64_t most;  // now
    std::uint64_t limit; // ever: not less
};

// The rule from look to look. However often it is interrupted, and whatever it may take now, a film comes to the same
// samples in the same tiles: as long as tiles are together they are looked at when all have the same; later a tile's
// decision depends on its own sums and the round alone, and a round ends when every tile has come to rest in it.
class AdaptivePlan {
public:
    AdaptivePlan(double target_error, const MostSamples &counts, FilmLooks film) :
        target_error_(target_error),
        counts_(counts),
        film_(std::move(film)) {}

    // Nothing if the film has the target error and has met the lamps in view; no tiles if none may take more. The goals
    // refer to these samples, which must outlive them. Moves on to the next round where one is over.
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
