// How radiance is shown: exposure, tone curve, display encoding and rounding to bytes, and the files of pictures
// for a display. One way for pictures that are rendered and for those made of a file of radiance, so that both have the
// same bits.
#pragma once

#include "cli/base/names.h"
#include "cli/image/image_file.h"

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

namespace cli {

using Color = std::array<double, 3>; // linear, Rec. 709 primaries

enum class ToneCurve {
    none,     // clamp to [0, 1]
    reinhard, // Reinhard et al. 2002
    aces,     // Narkowicz's fit of ACES, 2015
    agx,      // Sobotka's AgX base
    neutral   // Khronos PBR Neutral, 2024
};

inline constexpr ValueNames<5, ToneCurve> tone_curves({{"none", ToneCurve::none},
                                                       {"reinhard", ToneCurve::reinhard},
                                                       {"aces", ToneCurve::aces},
                                                       {"agx", ToneCurve::agx},
                                                       {"neutral", ToneCurve::neutral}});

struct ToneMap {
    double exposure = 0.0; // stops: radiance is multiplied by 2^exposure
    ToneCurve curve = ToneCurve::none;
    std::optional<double> gamma; // encode with the power 1 / gamma in place of the sRGB curve
    bool is_automatic = false;   // whether the exposure follows from the picture
};

// From radiance >= 0 to light of the display, each component in [0, 1].
Color apply_curve(ToneCurve curve, const Color &radiance);

// Light of the display in [0, 1] to the signal in [0, 1]: IEC 61966-2-1.
double encode_srgb(double light);

// From R, G, B triples of radiance >= 0 to as many bytes: 255 times the signal, rounded, halves up. No dither, so that
// equal pictures are equal files.
std::vector<std::uint8_t> map_to_bytes(std::span<const float> radiance, const ToneMap &map);

inline constexpr double largest_exposure = 64.0; // the least is its negative

// The stops that bring the average of an image to middle grey, 0.18: Reinhard, Stark, Shirley, Ferwerda 2002,
// "Photographic Tone Reproduction for Digital Images", eqs. 1 and 2, whose average is the exponential of the mean of
// the logarithms. It hardly depends on how bright the lamps in view are. Two things differ from that paper. A pixel
// counts by the mean of its channels instead of its luminance: blue light has so little luminance that it would be
// burnt out. And pixels below 1/128 of the picture's level count the less the darker they are; otherwise the logarithms
// of what looks black, such as the tails of lobes, would decide everything. The level is the mean after cutting values
// above the mean down to it, three times, so that a lamp in a hundredth of the pixels does not set it. Rounded to
// hundredths, so that the number that is shown gives the same picture. 0 if all is black.
double automatic_exposure(std::span<const float> radiance);

struct Display {
    std::optional<double> exposure; // stops; nothing: automatic
    ToneCurve curve = ToneCurve::none;
    std::optional<double> gamma; // nothing: the sRGB curve

    ToneMap tone_map(std::span<const float> radiance) const {
        return {exposure ? *exposure : automatic_exposure(radiance), curve, gamma, !exposure};
    }
};

// Describes in the metadata what was done to the radiance.
void add_tone_map(std::vector<ImageAttribute> &attributes, const ToneMap &tone_map);

// "exposure -3.13 EV (auto)" and the end of the line; empty where it was given, or nothing is tone-mapped.
std::string automatic_exposure_line(const std::optional<ToneMap> &tone_map);

// image: its window and attributes. radiance: R, G, B triples of the window's part, >= 0. alpha: of each pixel, by
// which its radiance is multiplied already; empty for none. Throws Failure(ExitCode::file), and leaves an
// existing file as it was.
void write_display_image(ImageWriter &writer, const ImageTarget &target, ImageData image,
                         std::span<const float> radiance, const ToneMap &tone_map, std::span<const float> alpha = {});

} // namespace cli
