#include "cli/image/display.h"

#include "cli/base/text.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>

namespace cli {
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

double automatic_exposure(std::span<const float> radiance) {
    constexpr double middle_grey = 0.18;
    constexpr double black = 1.0 / 128.0; // of the level
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
    return std::clamp(std::round(100.0 * stops) / 100.0, -largest_exposure, largest_exposure);
}

void add_tone_map(std::vector<ImageAttribute> &attributes, const ToneMap &tone_map) {
    attributes.push_back({"pt.toneMap", std::string(tone_curve_names[static_cast<std::size_t>(tone_map.curve)])});
    attributes.push_back({"pt.exposure", tone_map.exposure});
    attributes.push_back(tone_map.gamma ? ImageAttribute{"pt.gamma", *tone_map.gamma}
                                        : ImageAttribute{"pt.encoding", "sRGB"});
}

std::string automatic_exposure_line(const ToneMap &tone_map) {
    return formatted("exposure %.2f EV (auto)\n", tone_map.exposure);
}

void write_display_image(ImageWriter &writer, const ImageTarget &target, ImageData image,
                         std::span<const float> radiance, const ToneMap &tone_map, std::uint32_t png_bits,
                         std::span<const float> alpha) {
    const std::vector<float> covering = alpha.empty() ? std::vector<float>() : unassociated(radiance, alpha);
    const std::span<const float> colors = alpha.empty() ? radiance : covering;
    image.gamma = tone_map.gamma;
    const auto write = [&](auto signal, auto ImageData::*channels) {
        if (!alpha.empty())
            signal = with_alpha(signal, alpha);
        image.*channels = signal;
        writer.write(target, image);
    };
    if (target.format == ImageFormat::png && png_bits == 16)
        write(map_to_16_bits(colors, tone_map), &ImageData::words);
    else
        write(map_to_8_bits(colors, tone_map), &ImageData::bytes);
}

} // namespace cli
