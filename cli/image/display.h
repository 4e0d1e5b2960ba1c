// How radiance is shown: exposure, tone curve and encoding, and the files of pictures for a display. One way for
// pictures that are rendered and for those made of a file of radiance, so that both have the same bits.
#pragma once

#include "cli/image/image_file.h"
#include "cli/image/tone_map.h"

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

namespace cli {

inline constexpr double largest_exposure = 64.0; // the least is its negative

// The stops that bring the average of an image to middle grey, 0.18: Reinhard, Stark, Shirley, Ferwerda 2002,
// "Photographic Tone Reproduction for Digital Images", eqs. 1 and 2, whose average is the exponential of the mean of
// the logarithms. It hardly depends on how bright the lamps in view are. Unlike there, a pixel counts by the mean of
// its channels and not by luminance, of which blue light has so little that it would be burnt out; and the darker it is
// than 1/128 of the picture's level, the less it counts, since logarithms of what looks black, such as the tails of
// lobes, would decide all. The level is a mean with the values above the mean cut down to it, three times, so that a
// lamp in a hundredth of the pixels does not set it. Rounded to hundredths, so that the number that is shown gives the
// same picture. 0 if all is black.
double automatic_exposure(std::span<const float> radiance);

struct Display {
    std::optional<double> exposure; // stops; nothing: automatic
    ToneCurve curve = ToneCurve::none;
    std::optional<double> gamma; // nothing: the sRGB curve

    ToneMap tone_map(std::span<const float> radiance) const {
        return {exposure ? *exposure : automatic_exposure(radiance), curve, gamma};
    }
};

// What is done to the radiance, for the metadata.
void add_tone_map(std::vector<ImageAttribute> &attributes, const ToneMap &tone_map);

// "exposure -3.13 EV (auto)" and the end of the line.
std::string automatic_exposure_line(const ToneMap &tone_map);

// image: its window and attributes. radiance: R, G, B triples of the window's part, >= 0. png_bits: of a channel, 8 or
// 16; JPEG has 8. alpha: of each pixel, by which its radiance is multiplied already; empty for none, and for JPEG.
// Throws Failure(ExitCode::file), and leaves an existing file as it was.
void write_display_image(ImageWriter &writer, const ImageTarget &target, ImageData image,
                         std::span<const float> radiance, const ToneMap &tone_map, std::uint32_t png_bits,
                         std::span<const float> alpha = {});

} // namespace cli
