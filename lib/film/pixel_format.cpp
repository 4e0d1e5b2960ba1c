#include "lib/film/pixel_format.h"

#include "shaders/half.h"

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
    return static_cast<std::uint16_t>(gpu::half_bits(std::bit_cast<std::uint32_t>(value)));
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
