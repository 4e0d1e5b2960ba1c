// Exposure, tone curve, display encoding and rounding; the same bits for renderings and files of radiance.
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
    double exposure = 0.0; // stops: radiance times 2^exposure
    ToneCurve curve = ToneCurve::none;
    std::optional<double> gamma; // encode with the power 1 / gamma instead of the sRGB curve
    bool is_automatic = false;   // from the picture
};

// Radiance >= 0 to display light, each component in [0, 1].
Color apply_curve(ToneCurve curve, const Color &radiance);

// Display light to signal, both in [0, 1]: IEC 61966-2-1.
double encode_srgb(double light);

// Bytes are 255 times the signal, halves up. No dither: equal pictures are equal files.
std::vector<std::uint8_t> map_to_bytes(std::span<const float> radiance, const ToneMap &map);

inline constexpr double largest_exposure = 64.0; // the least is its negative

// Stops that bring the picture's average to middle grey, 0.18: Reinhard, Stark, Shirley, Ferwerda 2002, "Photographic
// Tone Reproduction for Digital Images", eqs. 1 and 2 (exponential of the mean logarithm). Two differences: the
// channels' mean replaces luminance, which would burn out blue; pixels below 1/128 of the level count less the darker
// they are, because logarithms of near black would dominate. The level is the mean after clipping to the mean three
// times, so that a lamp in a hundredth of the pixels does not set it. Rounded to hundredths, so that the number shown
// gives the same picture. 0 if all is black.
double automatic_exposure(std::span<const float> radiance);

struct Display {
    std::optional<double> exposure; // stops; empty: automatic
    ToneCurve curve = ToneCurve::none;
    std::optional<double> gamma; // empty: the sRGB curve

    ToneMap tone_map(std::span<const float> radiance) const {
        return {exposure ? *exposure : automatic_exposure(radiance), curve, gamma, !exposure};
    }
};

void add_tone_map(std::vector<ImageAttribute> &attributes, const ToneMap &tone_map);

// "exposure -3.13 EV (auto)" and a line end; empty without automatic exposure.
std::string automatic_exposure_line(const std::optional<ToneMap> &tone_map);

// radiance: R, G, B of the window's part, >= 0. alpha: per pixel, already multiplied into the radiance; or empty.
// Throws Failure(ExitCode::file), and leaves an existing file as it was.
void write_display_image(ImageWriter &writer, const ImageTarget &target, ImageData image,
                         std::span<const float> radiance, const ToneMap &tone_map, std::span<const float> alpha = {});

} // namespace cli
