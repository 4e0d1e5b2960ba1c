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

// The part of a lamp that lies in one pixel, or in each of some pixels if the camera spreads it.
struct LampPiece {
    std::uint32_t x; // among the rows
    std::uint32_t y;
    double share;     // of the pixel that it covers, or of the pixel's samples that meet it
    double lamp_size; // of the whole lamp, in pixels
    glm::dvec3 emission;
    double pixels = 1.0; // that are alike
};

// The lamps in these rows of an image: emitting spheres in view that cover less than half a pixel, do not move, and
// whose centres nothing hides. Of larger ones 16 samples, the fewest with which an error is stated, should meet 8
// times.
std::vector<LampPiece> small_lamps_in_view(const PreparedScene &scene, const Camera &camera, std::uint32_t width,
                                           std::uint32_t height, std::uint32_t first_row, std::uint32_t row_count);

// Sums of squares of errors over an image's values.
struct UnmetSquares {
    double square;
    double relative_square;
};

// Those expected of lamps that the samples of a pixel, whose number is asked for, should have met less than 8 times. A
// piece that covers a share p of the pixel is met by n p of n samples, with the variance n p (1 - p) if they are
// random. Of quasi-random points there is one in each of n cells of the pixel, so chance is left in the cells that the
// edge of the piece crosses: of a disc of n p cells some 4.5 sqrt(n p), with 0.13 each, or 0.6 sqrt(n p) together (the
// test counts). The mean of n samples, whose limit is p E, errs by E / n times the root of the variance. offset: that
// of a relative error (x - r)^2 / (r^2 + offset).
UnmetSquares unmet_squares(const std::vector<LampPiece> &pieces, double offset, bool is_random,
                           const std::function<std::uint64_t(const LampPiece &)> &samples);

} // namespace pt
