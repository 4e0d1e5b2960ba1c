// Two images of independent noise, both filtered, and how far each value moves towards its filtered one.
#pragma once

#include <cstddef>
#include <vector>

namespace pt {

inline constexpr std::size_t channel_count = 3;

// Each with width * height * 3 values.
struct Halves {
    std::size_t width;
    std::size_t height;
    const float *first;
    const float *second;
    const float *first_filtered;
    const float *second_filtered;
    std::vector<float> first_move;
    std::vector<float> second_move;

    std::size_t index(std::size_t x, std::size_t y, std::size_t channel) const {
        return (y * width + x) * channel_count + channel;
    }

    std::size_t value_count() const { return width * height * channel_count; }
};

} // namespace pt
