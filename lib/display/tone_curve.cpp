#include "lib/display/tone_curve.h"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace pt {

namespace {

using Rows = std::array<Color, 3>;

Color multiply(const Rows &rows, const Color &color) {
    Color product;
    for (std::size_t i = 0; i < 3; ++i)
        product[i] = rows[i][0] * color[0] + rows[i][1] * color[1] + rows[i][2] * color[2];
    return product;
}

Color clamp(Color color) {
    for (double &component : color)
        component = std::clamp(component, 0.0, 1.0);
    return color;
}

Color none(Color color) {
    return color;
}

// Reinhard et al. 2002, eq. 3. Applied to luminance, because compression of each channel would desaturate colors.
Color reinhard(Color color) {
    const double divisor = 1.0 + luminance(color);
    for (double &component : color)
        component /= divisor;
    return color;
}

// Narkowicz 2015, "ACES Filmic Tone Mapping Curve": a rational fit, with more contrast and saturation than ACES.
Color aces(Color color) {
    for (double &x : color)
        x = x * (2.51 * x + 0.03) / (x * (2.43 * x + 0.59) + 0.14);
    return color;
}

// Sobotka 2022, AgX (github.com/sobotka/AgX), base look, as in Wrensch 2023, "Minimal AgX Implementation": primaries
// inset, logarithm of 16.5 stops about middle grey, polynomial sigmoid (mean squared error 3.7e-6), primaries outset.
// Curves return light, so AgX's gamma of 2.2 is decoded.
Color agx(Color color) {
    static constexpr Rows inset{{{0.842479062253094, 0.0784335999999992, 0.0792237451477643},
                                 {0.0423282422610123, 0.878468636469772, 0.0791661274605434},
                                 {0.0423756549057051, 0.0784336, 0.879142973793104}}};
    static constexpr Rows outset{{{1.19687900512017, -0.0980208811401368, -0.0990297440797205},
                                  {-0.0528968517574562, 1.15190312990417, -0.0989611768448433},
                                  {-0.0529716355144438, -0.0980434501171241, 1.15107367264116}}};
    static constexpr std::array<double, 7> sigmoid{-0.00232, 0.1191, 0.4298, -6.868, 31.96, -40.14, 15.5};
    constexpr double lowest = -12.47393; // log2(0.18) - 10
    constexpr double highest = 4.026069; // log2(0.18) + 6.5

    Color signal = multiply(inset, color);
    for (double &component : signal) {
        const double stops = std::clamp(std::log2(component), lowest, highest); // also clamps log2(0) = -inf
        const double x = (stops - lowest) / (highest - lowest);
        const auto horner = [x](double sum, double coefficient) { return sum * x + coefficient; };
        component = std::accumulate(sigmoid.rbegin(), sigmoid.rend(), 0.0, horner);
    }
    Color light = clamp(multiply(outset, signal));
    for (double &component : light)
        component = std::pow(component, 2.2);
    return light;
}

// Khronos PBR Neutral Tone Mapper 2024 (github.com/KhronosGroup/ToneMapping): subtracts a Fresnel reflection of 4%,
// compresses peaks above 0.76 and fades them to white.
Color neutral(Color color) {
    constexpr double fresnel = 0.04;
    constexpr double start = 0.8 - fresnel;
    constexpr double range = 1.0 - start;
    constexpr double desaturation = 0.15;

    const double least = *std::min_element(color.begin(), color.end());
    // A parabola that joins the constant smoothly at 2 * fresnel.
    const double offset = least < 2.0 * fresnel ? least - least * least / (4.0 * fresnel) : fresnel;
    for (double &component : color)
        component -= offset;
    const double peak = *std::max_element(color.begin(), color.end());
    if (peak < start)
        return color;
    const double new_peak = 1.0 - range * range / (peak + range - start);
    const double white = 1.0 - 1.0 / (desaturation * (peak - new_peak) + 1.0);
    for (double &component : color)
        component = std::lerp(component * new_peak / peak, new_peak, white);
    return color;
}

constexpr std::array curves{none, reinhard, aces, agx, neutral}; // PT_CURVE_* are its indices

} // namespace

double luminance(const Color &color) {
    return 0.2126 * color[0] + 0.7152 * color[1] + 0.0722 * color[2];
}

bool is_curve(std::uint32_t curve) {
    return curve < curves.size();
}

Color apply_curve(std::uint32_t curve, const Color &radiance) {
    return clamp(curves[curve](radiance));
}

double encode_srgb(double light) {
    return light <= 0.0031308 ? 12.92 * light : 1.055 * std::pow(light, 1.0 / 2.4) - 0.055;
}

} // namespace pt
