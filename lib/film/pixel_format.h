// Writes pixels with the same bytes as shaders/resolve.comp.
#pragma once

#include "shaders/gpu_layout.h"

#include <pt/pt.h>

#include <cstddef>
#include <cstdint>
#include <span>

namespace pt {

constexpr std::uint32_t format_count = gpu::LAST_FORMAT + 1;

constexpr std::uint32_t component_bytes(std::uint32_t format) {
    return format == PT_FORMAT_RGBA16F ? 2 : 4;
}

constexpr std::uint32_t pixel_bytes(std::uint32_t format) {
    const std::uint32_t components = format == PT_FORMAT_R32UI ? 1 : format == PT_FORMAT_RGB32F ? 3 : 4;
    return components * component_bytes(format);
}

// See shaders/half.h.
std::uint16_t half_bits(float value);

// `values` has R, G and B of each pixel.
void write_pixels(std::span<const float> values, std::uint32_t format, std::byte *to);

} // namespace pt
