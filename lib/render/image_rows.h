// The caller's memory for an image, filled pixel by pixel in the order of rows. Used by Renderer.
#pragma once

#include "lib/render/image.h"

#include <cstddef>
#include <cstdint>
#include <span>

namespace pt {

class ImageRows {
public:
    explicit ImageRows(const Image &image);

    // Takes the next pixels, as the image wants them.
    void put(std::span<const std::byte> pixels);

    // Takes those that the rectangle has of consecutive pixels, from one on, of an image of this width. R, G, B of
    // each.
    void put_part(std::uint64_t first_pixel, std::uint32_t width, std::span<const float> values);

private:
    Image image_;
    std::size_t width_bytes_;
    std::uint64_t done_bytes_ = 0; // without gaps
};

} // namespace pt
