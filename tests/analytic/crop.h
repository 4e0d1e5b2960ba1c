// The part of an image around its middle. Used by the tests against exact values.
#pragma once

#include <pt/pt.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstdlib>

namespace analytic {

// The smallest image about the same middle that holds a pixel. A pinhole's pixels do not know how many others there
// are: with the distance of the image plane, height / (2 tan(fov / 2)) pixels, kept, they have the same rays. So a
// pixel costs what a row of its crop does, not what its image does.
struct Crop {
    std::uint32_t width;
    std::uint32_t height;
    std::uint32_t x; // of the pixel
    std::uint32_t y;
};

// Twice the distance from the middle to the farther edge of a pixel, which has the parity of size.
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

// The camera of a crop of an image of the given height.
inline pt_camera cropped(pt_camera camera, std::uint32_t height, std::uint32_t crop_height) {
    camera.vertical_fov = 2.0 * std::atan(std::tan(0.5 * camera.vertical_fov) * crop_height / height);
    return camera;
}

} // namespace analytic
