// The rules of an image in the caller's memory.
#include "lib/base/error.h"
#include "lib/render/image.h"
#include "tests/support/image_target.h"

#include <gtest/gtest.h>

#include <string>
#include <type_traits>

namespace {

constexpr std::uint32_t width = 5;
constexpr std::uint32_t height = 3;

alignas(16) float memory[256];

pt_image valid_image() {
    pt_image image = image_target(memory);
    image.size_bytes = height * width * 12;
    return image;
}

// The message of the error, or "accepted".
template <typename Source>
std::string message(const Source &image, std::uint32_t image_height = height,
                    pt::ImageSource of = pt::ImageSource::Context) {
    try {
        if constexpr (std::is_same_v<Source, pt_image>)
            pt::validated_image(image, width, image_height, of);
        else
            pt::validated_image(image, width, image_height);
    } catch (const pt::Error &error) {
        EXPECT_EQ(error.code(), PT_ERROR_INVALID_ARGUMENT);
        return error.what();
    }
    return "accepted";
}

TEST(Image, IsTightByDefault) {
    const pt::Image image = pt::validated_image(valid_image(), width, height, pt::ImageSource::Context);
    EXPECT_EQ(image.data, reinterpret_cast<std::byte *>(memory));
    EXPECT_EQ(image.layout.row_bytes, width * 12);
    EXPECT_EQ(image.layout.quantity, uint32_t{PT_QUANTITY_RADIANCE});
    EXPECT_EQ(image.layout.pixels, (pt::Rectangle{0, 0, width, height}));
}

TEST(Image, MayHaveGapsBetweenRows) {
    pt_image source = valid_image();
    source.row_bytes = 64;
    source.size_bytes = 2 * 64 + 60; // the last row needs no gap
    EXPECT_EQ(pt::validated_image(source, width, height, pt::ImageSource::Context).layout.row_bytes, 64U);
    --source.size_bytes;
    EXPECT_EQ(message(source),
              "image.size_bytes = 187: must be >= (height - 1) * row_bytes + width * 12 (2 * 64 + 60)");
}

TEST(Image, NeedsData) {
    pt_image image = valid_image();
    image.data = nullptr;
    EXPECT_EQ(message(image), "image.data = NULL: must not be NULL");
}

TEST(Image, NeedsAlignedData) {
    pt_image image = valid_image();
    image.data = reinterpret_cast<float *>(reinterpret_cast<std::uintptr_t>(memory) + 2);
    EXPECT_EQ(message(image), "image.data = " + std::to_string(reinterpret_cast<std::uintptr_t>(memory) + 2) +
                                  ": must be a multiple of 4");
}

TEST(Image, NeedsAKnownQuantity) {
    pt_image image = valid_image();
    image.quantity = PT_QUANTITY_STANDARD_ERROR;
    EXPECT_EQ(pt::validated_image(image, width, height, pt::ImageSource::Context).layout.quantity,
              uint32_t{PT_QUANTITY_STANDARD_ERROR});
    image.quantity = 8;
    EXPECT_EQ(message(image), "image.quantity = 8: must be a PT_QUANTITY_* of pt.h");
}

TEST(Image, OfFirstHitsIsOfAContextAlone) {
    pt_image image = valid_image();
    image.quantity = PT_QUANTITY_DEPTH;
    EXPECT_EQ(message(image), "accepted");
    const std::string refusal = "image.quantity = 3: must be PT_QUANTITY_RADIANCE, PT_QUANTITY_STANDARD_ERROR or "
                                "PT_QUANTITY_SAMPLE_COUNT here: what camera rays meet is read by pt_readback alone";
    EXPECT_EQ(message(image, height, pt::ImageSource::Samples), refusal);
    pt_buffer_image buffer{};
    buffer.struct_size = sizeof buffer;
    buffer.buffer = 77;
    buffer.size_bytes = 1000;
    buffer.quantity = PT_QUANTITY_DEPTH;
    EXPECT_EQ(message(buffer), refusal);
}

TEST(Image, OfObjectsIsWholeNumbersAndNoOtherIs) {
    pt_image image = valid_image();
    image.quantity = PT_QUANTITY_OBJECT;
    EXPECT_EQ(message(image), "image.format = 0: must be PT_FORMAT_R32UI, as the quantity is PT_QUANTITY_OBJECT");
    image.format = PT_FORMAT_R32UI;
    EXPECT_EQ(message(image), "accepted");
    EXPECT_EQ(pt::validated_image(image, width, height, pt::ImageSource::Context).layout.row_bytes, width * 4);
    image.quantity = PT_QUANTITY_DEPTH;
    EXPECT_EQ(message(image), "image.format = 3: PT_FORMAT_R32UI is for PT_QUANTITY_OBJECT alone");
}

TEST(Image, NeedsWholeFloatsInARow) {
    pt_image image = valid_image();
    image.size_bytes = 1024;
    image.row_bytes = 62;
    EXPECT_EQ(message(image), "image.row_bytes = 62: must be a multiple of 4");
}

TEST(Image, NeedsRowsOfItsWidth) {
    pt_image image = valid_image();
    image.row_bytes = 56;
    EXPECT_EQ(message(image), "image.row_bytes = 56: must be >= width * 12 (60)");
}

TEST(Image, NeedsAllItsBytes) {
    pt_image image = valid_image();
    --image.size_bytes;
    EXPECT_EQ(message(image), "image.size_bytes = 179: must be >= (height - 1) * row_bytes + width * 12 (2 * 60 + 60)");
    image.size_bytes = 0;
    EXPECT_EQ(message(image), "image.size_bytes = 0: must be >= (height - 1) * row_bytes + width * 12 (2 * 60 + 60)");
}

// 2 * 2^63 is 0 in 64 bits.
TEST(Image, RowsMustNotWrapAround) {
    pt_image image = valid_image();
    image.row_bytes = std::uint64_t{1} << 63;
    EXPECT_EQ(message(image), "image.size_bytes = 180: must be >= (height - 1) * row_bytes + width * 12 "
                              "(2 * 9223372036854775808 + 60)");
}

TEST(Image, OfOneRowMayHaveAnyDistance) {
    pt_image image = valid_image();
    image.size_bytes = 60;
    image.row_bytes = std::uint64_t{1} << 63;
    EXPECT_EQ(message(image, 1), "accepted");
}

// x, y, width, height
pt_image part(std::uint32_t x, std::uint32_t y, std::uint32_t part_width, std::uint32_t part_height) {
    pt_image image = valid_image();
    image.x = x;
    image.y = y;
    image.width = part_width;
    image.height = part_height;
    return image;
}

TEST(Image, MayBeARectangle) {
    const pt::ImageLayout layout =
        pt::validated_image(part(1, 2, 4, 1), width, height, pt::ImageSource::Context).layout;
    EXPECT_EQ(layout.pixels, (pt::Rectangle{1, 2, 4, 1}));
    EXPECT_EQ(layout.row_bytes, 48U);
    pt_image image = part(4, 0, 1, 3);
    image.size_bytes = 36;
    EXPECT_EQ(message(image), "accepted");
    image.size_bytes = 35;
    EXPECT_EQ(message(image), "image.size_bytes = 35: must be >= (height - 1) * row_bytes + width * 12 (2 * 12 + 12)");
}

TEST(Image, RectanglesHavePixelsOfTheImageAlone) {
    const std::string none = ": must be >= 1, but where x, y, width and height are all 0";
    EXPECT_EQ(message(part(0, 0, 0, 1)), "image.width = 0" + none);
    EXPECT_EQ(message(part(0, 0, 1, 0)), "image.height = 0" + none);
    EXPECT_EQ(message(part(1, 1, 0, 0)), "image.width = 0" + none + "\nimage.height = 0" + none);
    EXPECT_EQ(message(part(1, 0, 5, 1)), "image.x + width = 6: must be <= 5");
    EXPECT_EQ(message(part(0, 1, 1, 3)), "image.y + height = 4: must be <= 3");
    EXPECT_EQ(message(part(UINT32_MAX, 0, 2, 1)), "image.x + width = 4294967297: must be <= 5");
    EXPECT_EQ(message(part(0, UINT32_MAX, 1, UINT32_MAX)), "image.y + height = 8589934590: must be <= 3");
}

TEST(Image, NeedsAKnownFormat) {
    pt_image image = valid_image();
    image.format = 4;
    image.reserved = 1;
    EXPECT_EQ(message(image), "image.format = 4: must be a PT_FORMAT_* of pt.h\nimage.reserved = 1: must be 0");
}

TEST(Image, HasPixelsOfItsFormat) {
    pt_image image = valid_image();
    image.format = PT_FORMAT_RGBA32F;
    EXPECT_EQ(message(image), "image.size_bytes = 180: must be >= (height - 1) * row_bytes + width * 16 (2 * 80 + 80)");
    image.format = PT_FORMAT_RGBA16F;
    image.size_bytes = 120;
    EXPECT_EQ(pt::validated_image(image, width, height, pt::ImageSource::Context).layout.row_bytes, 40U);
    image.size_bytes = 2 * 42 + 40;
    image.row_bytes = 42;
    image.data = reinterpret_cast<char *>(memory) + 2;
    EXPECT_EQ(message(image), "accepted");
    image.row_bytes = 41;
    EXPECT_EQ(message(image), "image.row_bytes = 41: must be a multiple of 2");
}

pt_buffer_image valid_buffer() {
    pt_buffer_image image{};
    image.struct_size = sizeof image;
    image.buffer = 77;
    image.offset_bytes = 20;
    image.size_bytes = 200;
    return image;
}

TEST(BufferImage, IsWhatItSays) {
    pt_buffer_image source = valid_buffer();
    source.size_bytes = UINT64_MAX;
    source.row_bytes = 100;
    source.wait_semaphore = 5;
    source.signal_semaphore = 6;
    source.format = PT_FORMAT_RGBA16F;
    const pt::BufferImage image = pt::validated_image(source, width, height);
    EXPECT_EQ(image.buffer, 77U);
    EXPECT_EQ(image.offset_bytes, 20U);
    EXPECT_EQ(image.layout.row_bytes, 100U);
    EXPECT_EQ(image.layout.format, std::uint32_t{PT_FORMAT_RGBA16F});
    EXPECT_EQ(image.wait_semaphore, 5U);
    EXPECT_EQ(image.signal_semaphore, 6U);
    EXPECT_EQ(message(valid_buffer()), "accepted");
}

TEST(BufferImage, HasABuffer) {
    pt_buffer_image image = valid_buffer();
    image.buffer = 0;
    EXPECT_EQ(message(image), "image.buffer = 0: must be a VkBuffer");
}

TEST(BufferImage, IsMadeOfWords) {
    pt_buffer_image image = valid_buffer();
    image.offset_bytes = 18;
    image.row_bytes = 62;
    image.size_bytes = 1000;
    EXPECT_EQ(message(image),
              "image.offset_bytes = 18: must be a multiple of 4\nimage.row_bytes = 62: must be a multiple of 4");
}

TEST(BufferImage, LiesWithinTheBuffer) {
    pt_buffer_image image = valid_buffer();
    --image.size_bytes;
    EXPECT_EQ(message(image), "image.size_bytes = 199: must be >= offset_bytes + (height - 1) * row_bytes + width * 12 "
                              "(20 + 2 * 60 + 60)");
    image.offset_bytes = UINT64_MAX - 3; // with which sums would wrap around
    EXPECT_NE(message(image), "accepted");
}

} // namespace
