// Lamps in view that are smaller than a pixel: how their light is spread over pixels. That tells how far off an image
// is whose samples have not met them yet.
#pragma once

#include "lib/kernel/prepared_scene.h"
#include "lib/scene/camera.h"

#include <glm/glm.hpp>

#include <cstdint>
#include <functional>
#include <vector>

namespace pt {

// The part of a lamp that lies in one pixel, or in each of some pixels if a lens or the lamp's motion spreads it.
struct LampPiece {
    std::uint32_t x; // among the rows
    std::uint32_t y;
    double share;      // of the pixel that it covers, or of the pixel's samples that meet it
    double lamp_share; // the same of the pixel that the whole lamp covers most
    glm::dvec3 emission;
    double pixels = 1.0;    // that are alike
    bool is_spread = false; // by a lens or its motion: samples meet it at random

    // Samples of a pixel that are expected to meet the lamp with a standard deviation of a third: 8 at random; 3 if
    // points are one to a cell. From then on the samples show it.
    double enough_samples(bool is_random) const;
};

// The lamps in these rows of an image: emitting spheres in view that cover less than half a pixel or that less than
// half of a pixel's samples meet, because they move, are out of focus, or shine through translucent spheres. A lamp
// whose center is hidden by opaque surfaces is not in view.
std::vector<LampPiece> small_lamps_in_view(const PreparedScene &scene, const Camera &camera, std::uint32_t width,
                                           std::uint32_t height, std::uint32_t first_row, std::uint32_t row_count);

// The samples of a pixel that are enough for a lamp; 0 if the pixel without it would lack less than a tenth: its
// relative square, as below, is less than a hundredth.
std::uint64_t samples_to_meet(const LampPiece &piece, double offset, bool is_random);

// The sum of squares of errors that are expected, and its variance.
struct ExpectedSquares {
    double sum = 0.0;
    double variance = 0.0;

    // How many samples that met a lamp it rests on.
    double meetings() const { return sum * sum / variance; }
};

// Over an image's values.
struct UnmetSquares {
    ExpectedSquares square;
    ExpectedSquares relative_square;
};

// Those expected of lamps for which the samples of a pixel, whose number is asked for, are not enough. A piece that
// covers a share p of the pixel is met by n p of n samples, with the variance n p (1 - p) if they are random. Of
// quasi-random points there is one in each of n cells of the pixel, so chance is left in the cells that the edge of the
// piece crosses: of a disc of n p cells some 4.5 sqrt(n p), with 0.13 each, or 0.6 sqrt(n p) together (the test
// counts). The mean of n samples, whose limit is p E, errs by E / n times the root of the variance. offset: that of a
// relative error (x - r)^2 / (r^2 + offset).
UnmetSquares unmet_squares(const std::vector<LampPiece> &pieces, double offset, bool is_random,
                           const std::function<std::uint64_t(const LampPiece &)> &samples);

} // namespace pt
