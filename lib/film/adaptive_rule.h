// Which tiles of a film take more samples. A tile holds 16, 32, 64, ... samples a pixel and takes as many again while
// what that is expected to gain, for each sample it costs, exceeds a bound; the bound falls from round to round, until
// the error of the image is small enough. So samples go where they gain most: equal errors everywhere would take as
// many as an even film (mean squares v after equal times), equal gains take them in proportion to the root of v.
//
// Pure arithmetic on what a film says. A tile's decision depends on its own sums and on the round alone, so that at the
// end of a round it holds the first of these numbers of samples at which it gains no more than the bound: whatever the
// order in which tiles came to it, and whatever was interrupted on the way.
#pragma once

#include "lib/film/film_header.h"
#include "lib/film/tile_samples.h"

#include <cstdint>
#include <span>
#include <vector>

namespace pt {

// The next level of a tile above this number of samples: 16 times a power of two.
std::uint64_t next_level(std::uint64_t sample_count);
bool is_level(std::uint64_t sample_count);

// Tiles that were interrupted on their way to a level, or have not begun.
std::vector<std::uint32_t> unfinished_tiles(const TileSamples &samples);

// For each tile, by how much doubling its samples is expected to lessen its square error, divided by the number of
// samples that this costs; 0 if that is unknown. squares: for each tile the expected sum of squared relative errors.
std::vector<double> tile_gains(const TileSamples &samples, std::span<const double> squares);

// The error of the image as far as each tile knows its own part; tiles that know nothing do not count.
double error_of(const TileSamples &samples, std::span<const double> squares);

// Whether tiles of a film with the same samples everywhere differ so much that it pays to tell them apart.
bool are_worth_telling_apart(std::span<const double> gains);

// The tiles that are to double their samples in this round. All tiles are at a level.
std::vector<std::uint32_t> wanting_tiles(const TileSamples &samples, std::span<const double> gains,
                                         const AdaptiveRound &round);

// The next round, once no tile wants more samples in this one; in the next some tile does. excess: the square of (error
// of the image / target), > 1; infinite if the error is unknown. sees_too_little: much of the error is light that no
// sample has met (PT_UNCERTAIN_UNSEEN), perhaps of a neighbouring tile. Then the tiles with the fewest samples take
// more, and excess counts only what tiles themselves show, so it may be 1 or less.
AdaptiveRound round_after(const AdaptiveRound &round, const TileSamples &samples, std::span<const double> squares,
                          std::span<const double> gains, double excess, bool sees_too_little);

} // namespace pt
