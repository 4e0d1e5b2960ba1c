#pragma once

#include "cli/image/image_file.h"
#include "lib/scene_file/display.h"

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

namespace cli {

using Color = std::array<double, 3>; // linear Rec. 709

using pt::tone_curves;
using pt::ToneCurve;

struct ToneMap {
    double exposure = 0.0; // stops
    ToneCurve curve = ToneCurve::none;
    std::optional<double> gamma; // empty: the sRGB curve
    bool is_automatic = false;
};

// Converts non-negative radiance to display light in [0, 1].
Color apply_curve(ToneCurve curve, const Color &radiance);

// IEC 61966-2-1. light: in [0, 1].
double encode_srgb(double light);

// Returns 255 times the signal. Halves round up. There is no dither, so equal pictures give equal files.
std::vector<std::uint8_t> map_to_bytes(std::span<const float> radiance, const ToneMap &map);

// Returns the stops that bring the average to middle grey, 0.18: Reinhard, Stark, Shirley, Ferwerda 2002, eqs. 1 and 2.
// Differences: the mean of the channels replaces luminance, which would burn out blue. Pixels below 1/128 of the level
// have less weight. The level is the mean after clipping to the mean three times, so a small lamp does not set it.
// Rounded to hundredths, so that the printed number gives the same picture. 0 for black.
double automatic_exposure(std::span<const float> radiance);

inline ToneMap tone_map_for(const pt::Display &display, std::span<const float> radiance) {
    return {display.exposure ? *display.exposure : automatic_exposure(radiance), display.curve, display.gamma,
            !display.exposure};
}

void add_tone_map(std::vector<ImageAttribute> &attributes, const ToneMap &tone_map);

// Empty for a fixed exposure.
std::string automatic_exposure_line(const std::optional<ToneMap> &tone_map);

// radiance: R, G, B, non-negative, multiplied by alpha. alpha: one number per pixel, or empty. After a failure an
// existing file is unchanged. Throws Failure(ExitCode::file).
void write_display_image(ImageWriter &writer, const ImageTarget &target, ImageData image,
                         std::span<const float> radiance, const ToneMap &tone_map, std::span<const float> alpha = {});

} // namespace cli
