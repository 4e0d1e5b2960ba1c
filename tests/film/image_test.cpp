#include "lib/render/image.h"

#include "lib/film/pixel_format.h"
#include "tests/geometry/refusals.h"
#include "tests/support/half_edges.h"
#include "tests/support/image_target.h"
#include "tests/support/sized.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <span>
#include <string>

namespace {

constexpr std::uint32_t target_width = 5;
constexpr std::uint32_t target_height = 3;

alignas(16) float memory[256];

pt_image valid_image() {
    pt_image image = image_target(memory);
    image.size_bytes = target_height * target_width * 12;
    return image;
}

std::string image_outcome(const pt_image &image) {
    return outcome_of(PT_ERROR_INVALID_ARGUMENT,
                      [&] { pt::validated_image(image, target_width, target_height, pt::ImageSource::Context); });
}

pt_image part(std::uint32_t x, std::uint32_t y, std::uint32_t part_width, std::uint32_t part_height) {
    pt_image image = valid_image();
    set_part(image, {x, y, part_width, part_height});
    return image;
}

TEST(Image, HalvesMayLieAtEvenAddresses) {
    pt_image image = valid_image();
    image.format = PT_FORMAT_RGBA16F;
    image.size_bytes = 2 * 42 + 40;
    image.row_bytes = 42;
    image.data = reinterpret_cast<char *>(memory) + 2;
    EXPECT_EQ(image_outcome(image), "accepted");
}

const std::string none = ": must be >= 1, unless x, y, width and height are all 0";

TEST(Image, BrokenRulesAreNamed) {
    const std::string size = "must be >= (height - 1) * row_bytes + width * ";
    expect_refusals<pt_image>(
        valid_image(), image_outcome,
        {{[](pt_image &i) { i.data = nullptr; }, "image.data = NULL: must not be NULL"},
         {[](pt_image &i) { i.data = reinterpret_cast<char *>(memory) + 2; },
          "image.data = " + std::to_string(reinterpret_cast<std::uintptr_t>(memory) + 2) + ": must be a multiple of 4"},
         {[](pt_image &i) {
              i.quantity = 8;
              i.format = 4;
              i.reserved = 1;
          },
          "image.quantity = 8: must be a PT_QUANTITY_* of pt.h\nimage.format = 4: must be a PT_FORMAT_* of pt.h\n"
          "image.reserved = 1: must be 0"},
         {[](pt_image &i) { i.quantity = PT_QUANTITY_OBJECT; },
          "image.format = 0: must be PT_FORMAT_R32UI, because the quantity is PT_QUANTITY_OBJECT"},
         {[](pt_image &i) {
              i.quantity = PT_QUANTITY_DEPTH;
              i.format = PT_FORMAT_R32UI;
          },
          "image.format = 3: must not be PT_FORMAT_R32UI, which is only for PT_QUANTITY_OBJECT"},
         {[](pt_image &i) {
              i.size_bytes = 1024;
              i.row_bytes = 62;
          },
          "image.row_bytes = 62: must be a multiple of 4"},
         {[](pt_image &i) { i.row_bytes = 56; }, "image.row_bytes = 56: must be >= width * 12 (60)"},
         {[](pt_image &i) { --i.size_bytes; }, "image.size_bytes = 179: " + size + "12 (2 * 60 + 60)"},
         // 2 * 2^63 overflows to 0.
         {[](pt_image &i) { i.row_bytes = std::uint64_t{1} << 63; },
          "image.size_bytes = 180: " + size + "12 (2 * 9223372036854775808 + 60)"},
         {[](pt_image &i) { i.format = PT_FORMAT_RGBA32F; }, "image.size_bytes = 180: " + size + "16 (2 * 80 + 80)"},
         {[](pt_image &i) {
              i = part(4, 0, 1, 3);
              i.size_bytes = 35;
          },
          "image.size_bytes = 35: " + size + "12 (2 * 12 + 12)"},
         {[](pt_image &i) { i = part(1, 1, 0, 0); }, "image.width = 0" + none + "\nimage.height = 0" + none},
         {[](pt_image &i) { i = part(1, 0, 5, 1); }, "image.x + width = 6: must be <= 5"},
         {[](pt_image &i) { i = part(0, 1, 1, 3); }, "image.y + height = 4: must be <= 3"},
         {[](pt_image &i) { i = part(UINT32_MAX, 0, 2, 1); }, "image.x + width = 4294967297: must be <= 5"}});
}

pt_buffer_image valid_buffer() {
    auto image = sized<pt_buffer_image>();
    image.buffer = 77;
    image.offset_bytes = 20;
    image.size_bytes = 200;
    return image;
}

std::string buffer_outcome(const pt_buffer_image &image) {
    return outcome_of(PT_ERROR_INVALID_ARGUMENT, [&] { pt::validated_image(image, target_width, target_height); });
}

TEST(BufferImage, BrokenRulesAreNamed) {
    expect_refusals<pt_buffer_image>(
        valid_buffer(), buffer_outcome,
        {{[](pt_buffer_image &i) {
              i.buffer = 0;
              i.offset_bytes = 18;
              i.quantity = PT_QUANTITY_DEPTH;
              i.row_bytes = 62;
              i.size_bytes = 1000;
          },
          "image.buffer = 0: must be a VkBuffer\nimage.offset_bytes = 18: must be a multiple of 4\n"
          "image.quantity = 3: must be PT_QUANTITY_RADIANCE, PT_QUANTITY_STANDARD_ERROR, PT_QUANTITY_SAMPLE_COUNT "
          "or PT_QUANTITY_COVERAGE here: only pt_readback reads first hits\n"
          "image.row_bytes = 62: must be a multiple of 4"},
         {[](pt_buffer_image &i) { i.offset_bytes = UINT64_MAX - 3; },
          "image.size_bytes = 200: must be >= offset_bytes + (height - 1) * row_bytes + width * 12 "
          "(18446744073709551612 + 2 * 60 + 60)"}});
}

TEST(PixelFormat, HalvesAreTheNearest) {
    for (std::uint32_t half = 0; half < half_infinity; ++half) {
        const float exact = float_of_half(half);
        const float middle = middle_above_half(half);
        const std::uint32_t even = half + half % 2;
        ASSERT_EQ(pt::half_bits(exact), half) << exact;
        ASSERT_EQ(pt::half_bits(std::nextafter(middle, 0.0F)), half) << middle;
        ASSERT_EQ(pt::half_bits(middle), even) << middle;
        ASSERT_EQ(pt::half_bits(std::nextafter(middle, HUGE_VALF)), half + 1) << middle;
    }
    EXPECT_EQ(pt::half_bits(std::numeric_limits<float>::denorm_min()), 0U);
    for (const float large : {65536.0F, std::numeric_limits<float>::max(), HUGE_VALF})
        EXPECT_EQ(pt::half_bits(large), half_infinity) << large;
}

TEST(PixelFormat, PixelsHaveAnAlphaOfOne) {
    constexpr std::array<float, 6> values = {0.5F, 1.0F, 2.0F, 3.0F, 0.25F, 0.0F};
    std::array<float, 6> rgb{};
    std::array<float, 8> rgba{};
    std::array<std::uint16_t, 8> halves{};
    pt::write_pixels(values, PT_FORMAT_RGB32F, std::as_writable_bytes(std::span(rgb)).data());
    pt::write_pixels(values, PT_FORMAT_RGBA32F, std::as_writable_bytes(std::span(rgba)).data());
    pt::write_pixels(values, PT_FORMAT_RGBA16F, std::as_writable_bytes(std::span(halves)).data());
    EXPECT_EQ(rgb, values);
    EXPECT_EQ(rgba, (std::array<float, 8>{0.5F, 1.0F, 2.0F, 1.0F, 3.0F, 0.25F, 0.0F, 1.0F}));
    EXPECT_EQ(halves, (std::array<std::uint16_t, 8>{0x3800, 0x3c00, 0x4000, 0x3c00, 0x4200, 0x3400, 0, 0x3c00}));
}

} // namespace
