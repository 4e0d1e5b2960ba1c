#pragma once

#include <pt/pt.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstdlib>

namespace analytic {

// The smallest image that contains a pixel and has the same center as the whole image. The distance of the image plane,
// height / (2 tan(fov / 2)) pixels, stays the same, so the rays stay the same.
struct Crop {
    std::uint32_t width;
    std::uint32_t height;
    std::uint32_t x;
    std::uint32_t y;
};

inline std::uint32_t crop_size(std::uint32_t size, std::uint32_t position) {
    const auto twice = [&](std::uint32_t edge) {
        return static_cast<std::uint32_t>(std::abs(2 * std::int64_t{edge} - std::int64_t{size}));
    };
    return std::max(twice(position), twice(position + 1));
}

inline Crop crop_around(std::uint32_t width, std::uint32_t height, std::uint32_t x, std::uint32_t y) {
    const std::uint32_t crop_width = crop_size(width, x);
    const std::uint32_t crop_height = crop_size(height, y);
    return {crop_width, crop_height, x - (width - crop_width) / 2, y - (height - crop_height) / 2};
}

inline pt_camera cropped(pt_camera camera, std::uint32_t height, std::uint32_t crop_height) {
    camera.vertical_fov = 2.0 * std::atan(std::tan(0.5 * camera.vertical_fov) * crop_height / height);
    return camera;
}

} // namespace analytic
