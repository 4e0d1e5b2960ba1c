#include "lib/render/image.h"

#include "lib/base/error.h"
#include "lib/base/rules.h"
#include "lib/base/stream_copy.h"
#include "lib/film/pixel_format.h"
#include "lib/kernel/first_hits.h"
#include "shaders/gpu_layout.h"

#include <algorithm>
#include <string>
#include <vector>

namespace pt {

namespace {

constexpr std::uint32_t buffer_word_bytes = 4;

template <typename Source>
Rectangle rectangle_of(const Source &source, std::uint32_t width, std::uint32_t height) {
    if (source.x == 0 && source.y == 0 && source.width == 0 && source.height == 0)
        return {0, 0, width, height};
    return {source.x, source.y, source.width, source.height};
}

bool check_extent(const Subject &image, const char *name, std::uint32_t extent, const Member &begin,
                  std::uint32_t first, std::uint32_t limit) {
    image.require(extent >= 1, name, extent, "must be >= 1, unless x, y, width and height are all 0");
    const bool within = first < limit && extent <= limit - first;
    if (extent >= 1)
        image.require(within, begin, std::uint64_t{first} + extent, "must be <= " + number_text(limit));
    return within && extent >= 1;
}

void check_quantity(const Subject &image, std::uint32_t quantity, std::uint32_t format, ImageSource of) {
    const bool is_known = quantity <= gpu::LAST_QUANTITY;
    image.require(is_known, "quantity", quantity, "must be a PT_QUANTITY_* of pt.h");
    image.require(!is_known || of == ImageSource::Context || !is_of_first_hits(quantity), "quantity", quantity,
                  "must be PT_QUANTITY_RADIANCE, PT_QUANTITY_STANDARD_ERROR, PT_QUANTITY_SAMPLE_COUNT or "
                  "PT_QUANTITY_COVERAGE here: only pt_readback reads first hits");
    image.require(format < format_count, "format", format, "must be a PT_FORMAT_* of pt.h");
    image.require(format >= format_count || (format == PT_FORMAT_R32UI) == (quantity == PT_QUANTITY_OBJECT), "format",
                  format,
                  quantity == PT_QUANTITY_OBJECT ? "must be PT_FORMAT_R32UI, because the quantity is PT_QUANTITY_OBJECT"
                                                 : "must not be PT_FORMAT_R32UI, which is only for PT_QUANTITY_OBJECT");
}

// `alignment` of rows and `offset` of the image in its memory are in bytes.
template <typename Source>
ImageLayout checked_layout(const Subject &image, const Source &source, std::uint32_t alignment, std::uint64_t offset,
                           std::uint32_t width, std::uint32_t height, ImageSource of) {
    const ImageLayout layout{rectangle_of(source, width, height), source.quantity, source.format, source.row_bytes};
    const Rectangle &pixels = layout.pixels;
    check_quantity(image, source.quantity, source.format, of);
    image.require(source.reserved == 0, "reserved", source.reserved, "must be 0");
    const bool columns_fit = check_extent(image, "width", pixels.width, {"x", "+ width"}, pixels.x, width);
    const bool rows_fit = check_extent(image, "height", pixels.height, {"y", "+ height"}, pixels.y, height);
    if (!columns_fit || !rows_fit || source.format >= format_count)
        return layout;

    const std::string width_text = "width * " + number_text(pixel_bytes(source.format));
    const std::uint64_t width_bytes = std::uint64_t{pixels.width} * pixel_bytes(source.format);
    const std::uint64_t row_bytes = source.row_bytes == 0 ? width_bytes : source.row_bytes;
    image.require(row_bytes % alignment == 0, "row_bytes", row_bytes,
                  "must be a multiple of " + number_text(alignment));
    image.require(row_bytes >= width_bytes, "row_bytes", row_bytes,
                  "must be >= " + width_text + " (" + number_text(width_bytes) + ")");
    // offset + (height - 1) * row_bytes + width_bytes <= size_bytes, without overflow.
    const std::uint64_t room = source.size_bytes - std::min(source.size_bytes, offset);
    const bool large_enough = room >= width_bytes && (room - width_bytes) / row_bytes >= pixels.height - 1;
    const std::string before = offset == 0 ? "" : "offset_bytes + ";
    const std::string before_number = offset == 0 ? "" : number_text(offset) + " + ";
    image.require(large_enough, "size_bytes", source.size_bytes,
                  "must be >= " + before + "(height - 1) * row_bytes + " + width_text + " (" + before_number +
                      number_text(pixels.height - 1) + " * " + number_text(row_bytes) + " + " +
                      number_text(width_bytes) + ")");
    return {pixels, source.quantity, source.format, row_bytes};
}

} // namespace

Image validated_image(const pt_image &source, std::uint32_t width, std::uint32_t height, ImageSource of) {
    Violations violations;
    const Subject image(violations, "image");
    const std::uint32_t alignment = component_bytes(source.format);
    if (!source.data)
        image.refuse("data", "NULL", "must not be NULL");
    image.require(reinterpret_cast<std::uintptr_t>(source.data) % alignment == 0, "data",
                  std::uint64_t{reinterpret_cast<std::uintptr_t>(source.data)},
                  "must be a multiple of " + number_text(alignment));
    const ImageLayout layout = checked_layout(image, source, alignment, 0, width, height, of);
    violations.throw_if_any(PT_ERROR_INVALID_ARGUMENT);
    return {layout, static_cast<std::byte *>(source.data)};
}

ImageLayout validated_mapped_layout(const pt_image &source, std::uint32_t width, std::uint32_t height) {
    Violations violations;
    const Subject image(violations, "image");
    image.require(!source.data, "data", std::uint64_t{reinterpret_cast<std::uintptr_t>(source.data)},
                  "must be NULL: the memory is the library's");
    image.require(source.size_bytes == 0, "size_bytes", source.size_bytes, "must be 0: the memory is the library's");
    image.require(source.row_bytes == 0, "row_bytes", source.row_bytes, "must be 0: rows have no gaps");
    pt_image sized = source;
    sized.size_bytes = UINT64_MAX;
    sized.row_bytes = 0;
    const ImageLayout layout =
        checked_layout(image, sized, component_bytes(source.format), 0, width, height, ImageSource::Context);
    violations.throw_if_any(PT_ERROR_INVALID_ARGUMENT);
    return layout;
}

BufferImage validated_image(const pt_buffer_image &source, std::uint32_t width, std::uint32_t height) {
    Violations violations;
    const Subject image(violations, "image");
    if (source.buffer == 0)
        image.refuse("buffer", "0", "must be a VkBuffer");
    image.require(source.offset_bytes % buffer_word_bytes == 0, "offset_bytes", source.offset_bytes,
                  "must be a multiple of 4");
    const ImageLayout layout =
        checked_layout(image, source, buffer_word_bytes, source.offset_bytes, width, height, ImageSource::Samples);
    violations.throw_if_any(PT_ERROR_INVALID_ARGUMENT);
    return {layout, source.buffer, source.offset_bytes, source.wait_semaphore, source.signal_semaphore};
}

void require_coverage(std::uint32_t quantity, bool has_coverage) {
    if (quantity == PT_QUANTITY_COVERAGE && !has_coverage)
        refuse_argument("image", "quantity", std::to_string(quantity),
                        "PT_QUANTITY_COVERAGE needs samples that were taken with PT_RENDER_COVERAGE in "
                        "pt_render.flags");
}

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

void ImageRows::put(std::span<const float> values) {
    std::vector<std::byte> pixels(values.size() / 3 * pixel_bytes(image_.layout.format));
    write_pixels(values, image_.layout.format, pixels.data());
    put(pixels);
}

void ImageRows::put_part(std::uint64_t first_pixel, std::uint32_t width, std::span<const float> values) {
    const Rectangle &wanted = image_.layout.pixels;
    for (std::uint64_t pixel = first_pixel, end = first_pixel + values.size() / 3; pixel < end;) {
        const std::uint64_t row = pixel / width;
        const std::uint64_t first = std::max(pixel, row * width + wanted.x);
        const std::uint64_t last = std::min(end, row * width + wanted.x + wanted.width);
        if (first < last && row >= wanted.y && row - wanted.y < wanted.height)
            put(values.subspan(3 * (first - first_pixel), 3 * (last - first)));
        pixel = (row + 1) * width;
    }
}

} // namespace pt
