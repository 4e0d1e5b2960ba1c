#include "lib/render/image_rows.h"

#include "lib/base/stream_copy.h"
#include "lib/film/pixel_format.h"

#include <algorithm>
#include <vector>

namespace pt {

ImageRows::ImageRows(const Image &image) :
    image_(image),
    width_bytes_(std::size_t{image.layout.pixels.width} * pixel_bytes(image.layout.format)) {}

void ImageRows::put(std::span<const std::byte> pixels) {
    while (!pixels.empty()) {
        const std::size_t in_row = done_bytes_ % width_bytes_;
        const std::size_t count = std::min(pixels.size(), width_bytes_ - in_row);
        stream_copy(pixels.first(count), image_.data + done_bytes_ / width_bytes_ * image_.layout.row_bytes + in_row);
        pixels = pixels.subspan(count);
        done_bytes_ += count;
    }
}

void ImageRows::put_part(std::uint64_t first_pixel, std::uint32_t width, std::span<const float> values) {
    const Rectangle &wanted = image_.layout.pixels;
    std::vector<std::byte> pixels;
    for (std::uint64_t pixel = first_pixel, end = first_pixel + values.size() / 3; pixel < end;) {
        const std::uint64_t row = pixel / width;
        const std::uint64_t first = std::max(pixel, row * width + wanted.x);
        const std::uint64_t last = std::min(end, row * width + wanted.x + wanted.width);
        if (first < last && row >= wanted.y && row - wanted.y < wanted.height) {
            const std::span<const float> run = values.subspan(3 * (first - first_pixel), 3 * (last - first));
            pixels.resize((last - first) * pixel_bytes(image_.layout.format));
            write_pixels(run, image_.layout.format, pixels.data());
            put(pixels);
        }
        pixel = (row + 1) * width;
    }
}

} // namespace pt
