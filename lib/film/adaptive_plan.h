// What tiles of a film take next on their way to a target error: adaptive_rule.h from look to look.
//
// However often it is interrupted, and by whatever limits of samples, a film comes to the same samples in the same
// tiles: as long as tiles are together they are looked at when all have the same; later a tile's decision depends on
// its own sums and the round alone, and a round ends when every tile has come to rest in it.
#pragma once

#include "lib/film/error_estimate.h"
#include "lib/film/film_header.h"
#include "lib/film/tile_samples.h"

#include <cstdint>
#include <functional>
#include <optional>
#include <vector>

namespace pt {

// Tiles that are to take samples, in ascending order, and the number of samples that each is to have then.
struct TileStep {
    std::vector<std::uint32_t> tiles;
    std::function<std::uint64_t(std::uint32_t)> goal;
};

class AdaptivePlan {
public:
    using LookAtImage = std::function<ErrorEstimate()>;
    using LookAtTiles = std::function<std::vector<double>()>; // their own_square() of tile_errors.h

    // most: the largest number of samples for any pixel. error and squares look at the samples as they are at that
    // moment, which takes time.
    AdaptivePlan(double target_error, std::uint64_t most, LookAtImage error, LookAtTiles squares) :
        target_error_(target_error),
        most_(most),
        error_(std::move(error)),
        squares_(std::move(squares)) {}

    // Nothing if the film has the target error; no tiles if none may take more. The goals refer to these samples, which
    // must outlive them. Moves on to the next round where one is over.
    std::optional<TileStep> next(const TileSamples &samples, AdaptiveRound &round) const;

private:
    std::optional<TileStep> next_together(const TileSamples &samples, AdaptiveRound &round) const;
    std::optional<TileStep> next_apart(const TileSamples &samples, AdaptiveRound &round) const;
    TileStep to_next_level(const TileSamples &samples, std::vector<std::uint32_t> tiles) const;

    double target_error_;
    std::uint64_t most_;
    LookAtImage error_;
    LookAtTiles squares_;
};

} // namespace pt
