#pragma once

#include <array>
#include <cstdint>

namespace pt {

using Color = std::array<double, 3>; // linear Rec. 709

double luminance(const Color &color);

bool is_curve(std::uint32_t curve);

// Converts non-negative radiance to display light in [0, 1]. `curve` is a PT_CURVE_*.
Color apply_curve(std::uint32_t curve, const Color &radiance);

// IEC 61966-2-1. `light` is in [0, 1].
double encode_srgb(double light);

} // namespace pt
