// The rules of an image in the caller's memory.
#include "lib/api/image.h"
#include "lib/base/error.h"
#include "tests/support/image_target.h"

#include <gtest/gtest.h>

#include <string>

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
std::string message(const Source &image, std::uint32_t image_height = height) {
    try {
        pt::validated_image(image, width, image_height);
    } catch (const pt::Error &error) {
        EXPECT_EQ(error.code(), PT_ERROR_INVALID_ARGUMENT);
        return error.what();
    }
    return "accepted";
}

TEST(Image, IsTightByDefault) {
    const pt::Image image = pt::validated_image(valid_image(), width, height);
    EXPECT_EQ(image.data, reinterpret_cast<std::byte *>(memory));
    EXPECT_EQ(image.layout.row_bytes, width * 12);
    EXPECT_EQ(image.layout.quantity, uint32_t{PT_QUANTITY_RADIANCE});
    EXPECT_EQ(image.layout.pixels, (pt::Rectangle{0, 0, width, height}));
}

TEST(Image, MayHaveGapsBetweenRows) {
    pt_image source = valid_image();
    source.row_bytes = 64;
    source.size_bytes = 2 * 64 + 60; // the last row needs no gap
    EXPECT_EQ(pt::validated_image(source, width, height).layout.row_bytes, 64U);
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
    EXPECT_EQ(pt::validated_image(image, width, height).layout.quantity, uint32_t{PT_QUANTITY_STANDARD_ERROR});
    image.quantity = 2;
    EXPECT_EQ(message(image), "image.quantity = 2: must be a PT_QUANTITY_* of pt.h");
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

} // namespace
