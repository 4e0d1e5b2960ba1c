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

ImageError image_error(std::span<const float> image, std::span<const float> reference) {
    ImageError sum;
    for (std::size_t i = 0; i < image.size(); ++i) {
        const double expected = reference[i];
        const double difference = image[i] - expected;
        sum.mse += difference * difference;
        sum.relative_mse += difference * difference / (expected * expected + relative_offset);
    }
    const auto count = static_cast<double>(image.size());
    return {sum.mse / count, sum.relative_mse / count};
}

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
    for (std::size_t i = 0; i < image.size(); i += 3) {
        const Values pixel = image.subspan(i, 3);
        const Values wanted = reference.subspan(i, 3);
        if (!is_finite(pixel) || !is_finite(wanted)) {
            ++total.not_finite;
            continue;
        }
        const ImageError error = image_error(pixel, wanted);
        total.mse += error.mse;
        total.relative_mse += error.relative_mse;
        for (std::size_t channel = 0; channel < 3; ++channel) {
            const double difference = std::abs(double{pixel[channel]} - double{wanted[channel]});
            if (difference > total.maximum) {
                total.maximum = difference;
                total.maximum_value = i + channel;
            }
        }
    }
    const std::size_t pixel_count = image.size() / 3 - total.not_finite;
    if (pixel_count > 0) {
        total.mse /= static_cast<double>(pixel_count);
        total.relative_mse /= static_cast<double>(pixel_count);
    }
    return total;
}

std::vector<float> pixel_differences(Values image, Values reference) {
    std::vector<float> differences;
    differences.reserve(image.size() / 3);
    for (std::size_t i = 0; i < image.size(); i += 3) {
        const Values pixel = image.subspan(i, 3);
        const Values wanted = reference.subspan(i, 3);
        const bool known = is_finite(pixel) && is_finite(wanted);
        differences.push_back(known ? static_cast<float>(std::sqrt(image_error(pixel, wanted).relative_mse))
                                    : std::numeric_limits<float>::quiet_NaN());
    }
    return differences;
}

} // namespace cli
