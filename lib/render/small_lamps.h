#pragma once

#include "lib/kernel/prepared_scene.h"
#include "lib/scene/camera.h"

#include <glm/glm.hpp>

#include <cstdint>
#include <functional>
#include <vector>

namespace pt {

// The part of a lamp in one pixel, or in each of several equal pixels.
struct LampPiece {
    std::uint32_t x;
    std::uint32_t y;
    double share;      // fraction of samples that hit the lamp
    double lamp_share; // largest fraction of a pixel that the whole lamp covers
    glm::dvec3 emission;
    double pixels = 1.0;
    bool is_spread = false; // whether samples hit the piece at random

    // Samples per pixel from which the number of hits has a relative deviation of at most a third: 8 random hits, or 3
    // hits with one point per cell.
    double enough_samples(bool is_random) const;
};

// Returns the lamps in these rows that less than half of a pixel's samples hit. These lamps are smaller than half a
// pixel, move, are out of focus, or are behind translucent spheres. Lamps whose centers are behind opaque surfaces are
// left out.
std::vector<LampPiece> small_lamps_in_view(const PreparedScene &scene, const Camera &camera, std::uint32_t width,
                                           std::uint32_t height, std::uint32_t first_row, std::uint32_t row_count);

// Returns the samples per pixel that are enough for a lamp. Returns 0 if the relative square changes by less than a
// hundredth without the lamp.
std::uint64_t samples_to_hit(const LampPiece &piece, double offset, bool is_random);

struct ExpectedSquares {
    double sum = 0.0;
    double variance = 0.0;

    double hits() const { return sum * sum / variance; }
};

// Sums over an image's values.
struct UnmetSquares {
    ExpectedSquares square;
    ExpectedSquares relative_square;
};

// Sums the expected errors of lamps for which samples(piece) are too few. If n samples hit a piece of emission E with
// probability p, the number of hits has the mean n p. For random samples, the variance is n p (1 - p). Quasi-random
// points are one in each of n cells, so only cells at the edge of the piece are left to chance. A disc has about 4.5
// sqrt(n p) such cells with variance 0.13 each, in total 0.6 sqrt(n p). The error of the mean is E / n times the root
// of the variance. `offset` is as in (x - r)^2 / (r^2 + offset).
UnmetSquares unmet_squares(const std::vector<LampPiece> &pieces, double offset, bool is_random,
                           const std::function<std::uint64_t(const LampPiece &)> &samples);

} // namespace pt
