#pragma once

#include "lib/film/film_header.h"

#include <pt/pt.h>
#include <pt/vulkan.h>

#include <cstddef>
#include <cstdint>
#include <span>

namespace pt {

struct ImageLayout {
    Rectangle pixels;
    std::uint32_t quantity;
    std::uint32_t format;
    std::uint64_t row_bytes;
};

struct Image {
    ImageLayout layout;
    std::byte *data;
};

struct BufferImage {
    ImageLayout layout;
    std::uint64_t buffer;
    std::uint64_t offset_bytes;
    std::uint64_t wait_semaphore;   // VkSemaphore, or 0
    std::uint64_t signal_semaphore; // VkSemaphore, or 0
};

// A context has all quantities. Films and buffers have only those that come from samples.
enum class ImageSource { Context, Samples };

// Throws PT_ERROR_INVALID_ARGUMENT for PT_QUANTITY_COVERAGE without has_coverage.
void require_coverage(std::uint32_t quantity, bool has_coverage);

// source.struct_size must already be checked. width and height are the number of rendered columns and rows. Throws
// PT_ERROR_INVALID_ARGUMENT with all broken rules.
Image validated_image(const pt_image &source, std::uint32_t width, std::uint32_t height, ImageSource of);
ImageLayout validated_mapped_layout(const pt_image &source, std::uint32_t width, std::uint32_t height);
BufferImage validated_image(const pt_buffer_image &source, std::uint32_t width, std::uint32_t height);

class ImageRows {
public:
    explicit ImageRows(const Image &image);

    void put(std::span<const std::byte> pixels);
    void put(std::span<const float> values);

    // Takes consecutive pixels of an image of this width. Stores those within the rectangle.
    void put_part(std::uint64_t first_pixel, std::uint32_t width, std::span<const float> values);

private:
    Image image_;
    std::size_t width_bytes_;
    std::uint64_t done_bytes_ = 0;
};

} // namespace pt
