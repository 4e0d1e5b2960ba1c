#include "cli/image/display_image.h"

#include "cli/base/text.h"

#include <cmath>
#include <cstddef>
#include <limits>
#include <string>
#include <vector>

namespace cli {

void add_tone_map(ImageAttributes &attributes, const ToneMap &tone_map) {
    attributes.add("pt.toneMap", std::string(tone_curve_names[static_cast<std::size_t>(tone_map.curve)]));
    attributes.add_real("pt.exposure", tone_map.exposure);
    if (tone_map.gamma)
        attributes.add_real("pt.gamma", *tone_map.gamma);
    else
        attributes.add("pt.encoding", "sRGB");
}

std::string automatic_exposure_line(const ToneMap &tone_map) {
    return formatted("exposure %.2f EV (auto)\n", tone_map.exposure);
}

namespace {

// What covers the pixels, without the share of them that it covers; where that is none, black.
std::vector<float> unassociated(std::span<const float> radiance, std::span<const float> alpha) {
    std::vector<float> colors(radiance.size());
    for (std::size_t i = 0; i < colors.size(); ++i) {
        const float share = alpha[i / 3];
        colors[i] = share > 0.0F ? radiance[i] / share : 0.0F;
    }
    return colors;
}

// A, which is a share and encoded as it is, behind R, G and B of each pixel.
template <typename Signal>
std::vector<Signal> with_alpha(const std::vector<Signal> &colors, std::span<const float> alpha) {
    constexpr double largest = std::numeric_limits<Signal>::max();
    std::vector<Signal> pixels;
    pixels.reserve(4 * alpha.size());
    for (std::size_t pixel = 0; pixel < alpha.size(); ++pixel) {
        pixels.insert(pixels.end(), &colors[3 * pixel], &colors[3 * pixel] + 3);
        pixels.push_back(static_cast<Signal>(std::lround(alpha[pixel] * largest)));
    }
    return pixels;
}

} // namespace

void write_display_image(ImageWriter &writer, const ImageTarget &target, const ImageWindow &window,
                         std::span<const float> radiance, const ToneMap &tone_map, std::uint32_t png_bits,
                         std::span<const pt_image_attribute> attributes, std::span<const float> alpha) {
    if (!alpha.empty()) {
        const std::vector<float> colors = unassociated(radiance, alpha);
        if (png_bits == 16) {
            const std::vector<std::uint16_t> words = with_alpha(map_to_16_bits(colors, tone_map), alpha);
            writer.write_signal(target, window, words, attributes, tone_map.gamma);
        } else {
            const std::vector<std::uint8_t> bytes = with_alpha(map_to_8_bits(colors, tone_map), alpha);
            writer.write_signal(target, window, bytes, attributes, tone_map.gamma);
        }
        return;
    }
    if (target.format == ImageFormat::png && png_bits == 16)
        writer.write_signal(target, window, map_to_16_bits(radiance, tone_map), attributes, tone_map.gamma);
    else
        writer.write_signal(target, window, map_to_8_bits(radiance, tone_map), attributes, tone_map.gamma);
}

} // namespace cli
