// The 3x3 pixels around a pixel, in one channel. Pixels at the image's edge are repeated beyond the edge.
#pragma once

#include "lib/denoise/halves.h"
#include "shaders/neighbourhood.h"

#include <algorithm>
#include <array>

namespace pt {

template <typename Visit>
void for_each_about(const Halves &halves, std::size_t x, std::size_t y, std::size_t channel, Visit &&visit) {
    for (std::size_t row = 0; row < 3; ++row)
        for (std::size_t column = 0; column < 3; ++column)
            visit(halves.index(std::clamp<std::size_t>(x + column, 1, halves.width) - 1,
                               std::clamp<std::size_t>(y + row, 1, halves.height) - 1, channel));
}

template <typename Value>
float median_about(const Halves &halves, std::size_t x, std::size_t y, std::size_t channel, Value &&value) {
    std::array<float, 9> values{};
    float *next = values.data();
    for_each_about(halves, x, y, channel, [&](std::size_t index) { *next++ = value(halves, index); });
    return gpu::median_of_rows(gpu::sorted(values[0], values[1], values[2]),
                               gpu::sorted(values[3], values[4], values[5]),
                               gpu::sorted(values[6], values[7], values[8]));
}

} // namespace pt
