// Decides which tiles of a film take more samples (shaders/README.md, section 11). A tile's number of samples per pixel
// is one of the levels 16, 32, 64, .... A tile's gain is the expected decrease of the squared error per added sample.
#pragma once

#include "lib/film/film_header.h"
#include "lib/film/stopping.h"
#include "lib/film/tile_samples.h"

#include <cstdint>
#include <functional>
#include <optional>
#include <span>
#include <utility>
#include <vector>

namespace pt {

std::uint64_t next_level(std::uint64_t sample_count);
bool is_level(std::uint64_t sample_count);

// Returns the gain of each tile up to a constant factor, or 0 if it is unknown. `squares` has the expected sum of
// squared relative errors of each tile.
std::vector<double> tile_gains(const TileSamples &samples, std::span<const double> squares);

bool are_worth_telling_apart(std::span<const double> gains);

// Returns the tiles that double their samples in this round. The count of each tile must be a level. `lamps` has the
// samples per pixel with which each tile hits lamps smaller than a pixel.
std::vector<std::uint32_t> wanting_tiles(const TileSamples &samples, std::span<const double> gains,
                                         std::span<const std::uint64_t> lamps, const AdaptiveRound &round);

// Returns the first round of a film that needs more samples only for small lamps.
AdaptiveRound round_of_lamps(std::span<const double> gains);

// Returns the next round in which a tile wants samples. `excess` is (error / target)^2, infinite if the error is
// unknown. `sees_too_little` means that much of the error is light that no sample has hit (PT_UNCERTAIN_UNSEEN). Then
// `excess` does not include this light, and the tiles with the fewest samples take more.
AdaptiveRound round_after(const AdaptiveRound &round, const TileSamples &samples, std::span<const double> squares,
                          std::span<const double> gains, double excess, bool sees_too_little);

struct TileStep {
    std::vector<std::uint32_t> tiles;
    std::function<std::uint64_t(std::uint32_t)> goal; // samples per pixel
};

// Functions that read the film. All are slow.
struct FilmLooks {
    std::function<ErrorEstimate()> error;
    std::function<std::vector<double>()> squares;

    std::function<std::vector<std::uint64_t>()> samples_for_lamps;
};

struct MostSamples {
    std::uint64_t most;
    std::uint64_t limit; // limit over all calls
};

// While tiles have equal samples, the error is checked at fixed counts. Later, only a tile's own sums and the round
// decide whether it needs samples. So interruptions do not change the film.
class AdaptivePlan {
public:
    AdaptivePlan(const Stopping &stopping, const MostSamples &counts, FilmLooks film) :
        stopping_(stopping),
        counts_(counts),
        film_(std::move(film)) {}

    // Returns no value if the film has the target error and enough samples for the lamps in view. Returns no tiles if
    // no tile may take more samples. The goals refer to `samples`, which must outlive them. Sets `round` to the next
    // round when a round ends.
    std::optional<TileStep> next(const TileSamples &samples, AdaptiveRound &round) const;

private:
    std::optional<TileStep> next_together(const TileSamples &samples, AdaptiveRound &round) const;
    std::optional<TileStep> next_apart(const TileSamples &samples, AdaptiveRound &round) const;
    std::optional<TileStep> next_on_target(const TileSamples &samples, AdaptiveRound &round) const;
    std::vector<std::uint32_t> unfinished_tiles(const TileSamples &samples) const;
    TileStep to_next_level(const TileSamples &samples, std::vector<std::uint32_t> tiles) const;

    Stopping stopping_;
    MostSamples counts_;
    FilmLooks film_;
};

} // namespace pt
