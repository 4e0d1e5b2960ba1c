// Two images of independent noise, their filtered versions, and the move of each value towards its filtered value.
#pragma once

#include <cstddef>
#include <vector>

namespace pt {

inline constexpr std::size_t channel_count = 3;

// Each array has width * height * 3 values.
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
