#pragma once

#include "lib/view/prepared_scene.h"
#include "lib/view/projection.h"

#include <glm/glm.hpp>

#include <cstdint>
#include <functional>
#include <vector>

namespace pt {

// The part of a lamp in one pixel, or in each of several similar pixels.
struct LampPiece {
    std::uint32_t x;
    std::uint32_t y;
    double share;      // fraction of samples that hit the lamp
    double lamp_share; // largest fraction of a pixel that the lamp covers
    glm::dvec3 emission;
    double pixels = 1.0;
    bool is_spread = false; // whether even quasi-random samples hit the piece at random

    // Samples per pixel for 8 hits of random points or 3 of quasi-random ones.
    double enough_samples(bool is_random) const;
};

// Returns the lamps in these rows that are hit by less than half of a pixel's samples, because they are small, move,
// are out of focus, or are behind translucent spheres. Lamps whose centers are behind opaque surfaces are left out.
std::vector<LampPiece> small_lamps_in_view(const PreparedScene &scene, const Projection &projection,
                                           std::uint32_t first_row, std::uint32_t row_count);

// Returns the samples per pixel that are enough for a lamp. Returns 0 for a faint lamp: x^2 / (x^2 + offset) < 1/100,
// where x is the lamp's light in its brightest channel.
std::uint64_t samples_to_hit(const LampPiece &piece, double offset, bool is_random);

struct ExpectedSquares {
    double sum = 0.0;
    double variance = 0.0;

    double hits() const { return sum * sum / variance; }
};

struct UnmetSquares {
    ExpectedSquares square;
    ExpectedSquares relative_square;
};

// Sums the expected errors of lamps for which samples(piece) are too few. If each of n random samples hits a piece with
// probability p, the number of hits has the variance n p (1 - p). Quasi-random samples have one point in each of n
// cells, so only cells on the edge of the piece contribute to the variance. A disc has about 4.5 sqrt(n p) edge cells.
// Each adds 0.13, so the variance is 0.6 sqrt(n p). `offset` is as in (x - r)^2 / (r^2 + offset).
UnmetSquares unmet_squares(const std::vector<LampPiece> &pieces, double offset, bool is_random,
                           const std::function<std::uint64_t(const LampPiece &)> &samples);

} // namespace pt
