#include "cli/image/tone_map.h"

#include "cli/base/tasks.h"
#include "cli/base/text.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

namespace cli {
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

// Reinhard, Stark, Shirley, Ferwerda 2002, "Photographic Tone Reproduction for Digital Images", eq. 3: Ld = L / (1 +
// L). Applied to luminance, because saturated colors would be washed out if each channel were compressed alone.
Color reinhard(Color color) {
    const double luminance = 0.2126 * color[0] + 0.7152 * color[1] + 0.0722 * color[2]; // Rec. 709
    for (double &component : color)
        component /= 1.0 + luminance;
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
Color agx(const Color &color) {
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
        const double stops = std::clamp(std::log2(component), lowest, highest); // clamps log2(0) = -inf, too
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
    // a parabola with the constant's value and slope at 2 * fresnel
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

double encode(const ToneMap &map, double light) {
    return map.gamma ? std::pow(light, 1.0 / *map.gamma) : encode_srgb(light);
}

// Divides by alpha. Without coverage the result is 0.
std::vector<float> unassociated(std::span<const float> radiance, std::span<const float> alpha) {
    std::vector<float> colors(radiance.size());
    for (std::size_t i = 0; i < colors.size(); ++i) {
        const float share = alpha[i / 3];
        colors[i] = share > 0.0F ? radiance[i] / share : 0.0F;
    }
    return colors;
}

// Alpha has no gamma.
std::vector<std::uint8_t> with_alpha(std::span<const std::uint8_t> colors, std::span<const float> alpha) {
    std::vector<std::uint8_t> pixels;
    pixels.reserve(4 * alpha.size());
    for (std::size_t pixel = 0; pixel < alpha.size(); ++pixel) {
        pixels.insert(pixels.end(), &colors[3 * pixel], &colors[3 * pixel] + 3);
        pixels.push_back(static_cast<std::uint8_t>(std::lround(alpha[pixel] * 255.0)));
    }
    return pixels;
}

} // namespace

Color apply_curve(ToneCurve curve, const Color &radiance) {
    switch (curve) {
    case ToneCurve::reinhard:
        return clamp(reinhard(radiance));
    case ToneCurve::aces:
        return clamp(aces(radiance));
    case ToneCurve::agx:
        return agx(radiance);
    case ToneCurve::neutral:
        return clamp(neutral(radiance));
    case ToneCurve::none:
        break;
    }
    return clamp(radiance);
}

double encode_srgb(double light) {
    return light <= 0.0031308 ? 12.92 * light : 1.055 * std::pow(light, 1.0 / 2.4) - 0.055;
}

std::vector<std::uint8_t> map_to_bytes(std::span<const float> radiance, const ToneMap &map) {
    const double scale = std::exp2(map.exposure);
    std::vector<std::uint8_t> bytes(radiance.size());
    constexpr std::size_t grain = 20'000; // pixels; two milliseconds
    in_parallel(radiance.size() / 3, grain, [&](std::size_t first, std::size_t end) {
        for (std::size_t i = 3 * first; i < 3 * end; i += 3) {
            const Color light =
                apply_curve(map.curve, {radiance[i] * scale, radiance[i + 1] * scale, radiance[i + 2] * scale});
            for (std::size_t channel = 0; channel < 3; ++channel)
                bytes[i + channel] = static_cast<std::uint8_t>(std::lround(encode(map, light[channel]) * 255.0));
        }
    });
    return bytes;
}

double automatic_exposure(std::span<const float> radiance) {
    constexpr double middle_grey = 0.18;
    constexpr double black = 1.0 / 128.0; // fraction of the level
    std::vector<double> means;
    for (std::size_t i = 0; i + 2 < radiance.size(); i += 3)
        if (const double mean = (static_cast<double>(radiance[i]) + radiance[i + 1] + radiance[i + 2]) / 3.0;
            mean > 0.0)
            means.push_back(mean);
    double level = std::numeric_limits<double>::infinity();
    for (int cut = 0; cut <= 3; ++cut) {
        double sum = 0.0;
        for (const double mean : means)
            sum += std::min(mean, level);
        level = sum / static_cast<double>(means.size());
    }
    double sum = 0.0;
    double weights = 0.0;
    for (const double mean : means) {
        const double weight = mean / (mean + black * level);
        sum += weight * std::log2(mean);
        weights += weight;
    }
    const double stops = means.empty() ? 0.0 : std::log2(middle_grey) - sum / weights;
    return std::clamp(std::round(100.0 * stops) / 100.0, -pt::largest_exposure, pt::largest_exposure);
}

void add_tone_map(std::vector<ImageAttribute> &attributes, const ToneMap &tone_map) {
    attributes.push_back({"pt.toneMap", std::string(tone_curves.name(tone_map.curve))});
    attributes.push_back({"pt.exposure", tone_map.exposure});
    attributes.push_back(tone_map.gamma ? ImageAttribute{"pt.gamma", *tone_map.gamma}
                                        : ImageAttribute{"pt.encoding", "sRGB"});
}

std::string automatic_exposure_line(const std::optional<ToneMap> &tone_map) {
    return tone_map && tone_map->is_automatic ? formatted("exposure %.2f EV (auto)\n", tone_map->exposure) : "";
}

void write_display_image(ImageWriter &writer, const ImageTarget &target, ImageData image,
                         std::span<const float> radiance, const ToneMap &tone_map, std::span<const float> alpha) {
    std::vector<std::uint8_t> bytes = map_to_bytes(alpha.empty() ? radiance : unassociated(radiance, alpha), tone_map);
    if (!alpha.empty())
        bytes = with_alpha(bytes, alpha);
    image.signals = bytes;
    image.gamma = tone_map.gamma;
    writer.write(target, image);
}

} // namespace cli
