#include "lib/film/pixel_format.h"

#include <algorithm>
#include <bit>
#include <cstring>

namespace pt {

namespace {

template <typename Convert>
void write_with_alpha(std::span<const float> values, std::byte *to, const Convert &convert) {
    for (std::size_t first = 0; first < values.size(); first += 3) {
        const decltype(convert(1.0F)) pixel[] = {convert(values[first]), convert(values[first + 1]),
                                                 convert(values[first + 2]), convert(1.0F)};
        std::memcpy(to, pixel, sizeof pixel);
        to += sizeof pixel;
    }
}

} // namespace

std::uint16_t half_bits(float value) {
    constexpr std::uint32_t smallest_normal = 0x38800000; // 2^-14
    constexpr std::uint32_t difference_of_biases = 0x38000000;
    constexpr std::uint32_t half_infinity = 0x7c00;
    const auto float_bits = std::bit_cast<std::uint32_t>(value);

    const bool normal = float_bits >= smallest_normal;
    const std::uint32_t number = normal ? float_bits - difference_of_biases : (float_bits & 0x7fffff) | 0x800000;
    const std::uint32_t dropped = normal ? 13 : std::min(126 - (float_bits >> 23), 25U);
    const std::uint32_t kept = number >> dropped;
    const std::uint32_t rest = number & ((1U << dropped) - 1);
    const std::uint32_t half_of_last = 1U << (dropped - 1);
    const bool up = rest > half_of_last || (rest == half_of_last && kept % 2 == 1);

    return static_cast<std::uint16_t>(std::min(kept + (up ? 1U : 0U), half_infinity));
}

void write_pixels(std::span<const float> values, std::uint32_t format, std::byte *to) {
    if (format == PT_FORMAT_RGB32F)
        std::memcpy(to, values.data(), values.size_bytes());
    else if (format == PT_FORMAT_RGBA32F)
        write_with_alpha(values, to, [](float value) { return value; });
    else
        write_with_alpha(values, to, half_bits);
}

} // namespace pt
