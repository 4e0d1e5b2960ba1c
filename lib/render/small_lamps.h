// Lamps in view that are smaller than a pixel, and the error of images whose samples have hardly met them.
#pragma once

#include "lib/kernel/prepared_scene.h"
#include "lib/scene/camera.h"

#include <glm/glm.hpp>

#include <cstdint>
#include <functional>
#include <vector>

namespace pt {

// The part of a lamp in one pixel, or in each of several if a lens or the lamp's motion spreads it.
struct LampPiece {
    std::uint32_t x; // among the rows
    std::uint32_t y;
    double share;      // covered share of the pixel, or share of its samples that hit the lamp
    double lamp_share; // the largest share of a pixel that the whole lamp covers
    glm::dvec3 emission;
    double pixels = 1.0;    // number of pixels alike
    bool is_spread = false; // a lens or motion spreads it, so samples hit it at random

    // Samples of a pixel after which the number of hits deviates by a third: 8 random hits, or 3 with one point per
    // cell. From then on the samples show the lamp.
    double enough_samples(bool is_random) const;
};

// Emitting spheres in these rows that cover less than half a pixel, or that less than half of a pixel's samples hit:
// they move, are out of focus, or shine through translucent spheres. Opaque surfaces before its center hide a lamp.
std::vector<LampPiece> small_lamps_in_view(const PreparedScene &scene, const Camera &camera, std::uint32_t width,
                                           std::uint32_t height, std::uint32_t first_row, std::uint32_t row_count);

// Samples of a pixel that suffice for a lamp; 0 if the pixel without it has a relative square under a hundredth.
std::uint64_t samples_to_meet(const LampPiece &piece, double offset, bool is_random);

// The expected sum of squared errors, and its variance.
struct ExpectedSquares {
    double sum = 0.0;
    double variance = 0.0;

    // Effective number of lamp hits behind the sum.
    double meetings() const { return sum * sum / variance; }
};

// Sums over an image's values.
struct UnmetSquares {
    ExpectedSquares square;
    ExpectedSquares relative_square;
};

// For lamps that a pixel's samples(piece) are too few to show. A piece that covers a share p of the pixel is hit by n p
// of n samples, with the variance n p (1 - p) if they are random. Quasi-random points lie one in each of n cells, so
// chance is left only in cells at the piece's edge: some 4.5 sqrt(n p) for a disc, with 0.13 each, or 0.6 sqrt(n p) in
// all. The mean, whose limit is p E, errs by E / n times the root of the variance. offset: as in (x - r)^2 / (r^2 +
// offset).
UnmetSquares unmet_squares(const std::vector<LampPiece> &pieces, double offset, bool is_random,
                           const std::function<std::uint64_t(const LampPiece &)> &samples);

} // namespace pt
