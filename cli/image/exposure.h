// The exposure of tone-mapped pictures: a number of stops, or the one that suits the image.
#pragma once

#include <optional>
#include <span>
#include <string_view>

namespace cli {

struct Exposure {
    std::optional<double> stops; // nothing: automatic
};

inline constexpr double largest_exposure = 64.0; // the least is its negative

// "-1.5" or "auto"; nothing if it is neither, or beyond the largest exposure.
std::optional<Exposure> parse_exposure(std::string_view text);

// The stops that bring the average of an image to middle grey, 0.18: Reinhard, Stark, Shirley, Ferwerda 2002,
// "Photographic Tone Reproduction for Digital Images", eqs. 1 and 2, whose average is the exponential of the mean of
// the logarithms. It hardly depends on how bright the lamps in view are. Unlike there, a pixel counts by the mean of
// its channels and not by luminance, of which blue light has so little that it would be burnt out; and black pixels,
// which have no logarithm, do not count. Rounded to hundredths, so that the number that is shown gives the same
// picture. 0 if all is black.
double automatic_exposure(std::span<const float> radiance);

} // namespace cli
