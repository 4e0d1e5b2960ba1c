#include "cli/compare/image_difference.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace cli {
namespace {

using Values = std::span<const float>;

// Keeps black pixels from counting without bound.
constexpr double relative_offset = 0.01;

// 0xRRGGBB
constexpr std::array<std::uint32_t, 52> nodes{
    0x440154, 0x46085c, 0x471063, 0x481769, 0x481d6f, 0x482475, 0x472a7a, 0x46307e, 0x453781, 0x433d84, 0x414287,
    0x3f4889, 0x3d4e8a, 0x3a538b, 0x38598c, 0x355e8d, 0x33638d, 0x31688e, 0x2e6d8e, 0x2c718e, 0x2a768e, 0x297b8e,
    0x27808e, 0x25848e, 0x23898e, 0x218e8d, 0x20928c, 0x1f978b, 0x1e9c89, 0x1fa188, 0x21a585, 0x24aa83, 0x28ae80,
    0x2eb37c, 0x35b779, 0x3dbc74, 0x46c06f, 0x50c46a, 0x5ac864, 0x65cb5e, 0x70cf57, 0x7cd250, 0x89d548, 0x95d840,
    0xa2da37, 0xb0dd2f, 0xbddf26, 0xcae11f, 0xd8e219, 0xe5e419, 0xf1e51d, 0xfde725};

bool is_finite(Values pixel) {
    return std::all_of(pixel.begin(), pixel.end(), [](float value) { return std::isfinite(value); });
}

} // namespace

std::array<std::uint8_t, 3> viridis(double number) {
    const double place = std::clamp(number, 0.0, 1.0) * (nodes.size() - 1);
    const std::size_t node = std::min(static_cast<std::size_t>(place), nodes.size() - 2);
    std::array<std::uint8_t, 3> color{};
    for (std::size_t channel = 0; channel < 3; ++channel) {
        const auto component = [&](std::size_t of) { return double(nodes[of] >> (16 - 8 * channel) & 0xff); };
        const double value = std::lerp(component(node), component(node + 1), place - static_cast<double>(node));
        color[channel] = static_cast<std::uint8_t>(std::lround(value));
    }
    return color;
}

ImageDifference compare_images(Values image, Values reference) {
    ImageDifference total{};
    total.pixels.reserve(image.size() / 3);
    for (std::size_t i = 0; i < image.size(); i += 3) {
        if (!is_finite(image.subspan(i, 3)) || !is_finite(reference.subspan(i, 3))) {
            ++total.not_finite;
            total.pixels.push_back(std::numeric_limits<float>::quiet_NaN());
            continue;
        }
        double relative = 0.0;
        for (std::size_t value = i; value < i + 3; ++value) {
            const double expected = reference[value];
            const double difference = std::abs(image[value] - expected);
            total.mse += difference * difference;
            relative += difference * difference / (expected * expected + relative_offset);
            if (difference > total.maximum) {
                total.maximum = difference;
                total.maximum_value = value;
            }
        }
        total.relative_mse += relative;
        total.pixels.push_back(static_cast<float>(std::sqrt(relative / 3.0)));
    }
    const std::size_t value_count = image.size() - 3 * total.not_finite;
    if (value_count > 0) {
        total.mse /= static_cast<double>(value_count);
        total.relative_mse /= static_cast<double>(value_count);
    }
    return total;
}

} // namespace cli
