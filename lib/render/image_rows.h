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

    // Takes the next pixels, in the format of the image.
    void put(std::span<const std::byte> pixels);

    // Takes consecutive pixels of an image of this width, from first_pixel on, and keeps those within the rectangle. R,
    // G and B for each.
    void put_part(std::uint64_t first_pixel, std::uint32_t width, std::span<const float> values);

private:
    Image image_;
    std::size_t width_bytes_;
    std::uint64_t done_bytes_ = 0; // without gaps
};

} // namespace pt
