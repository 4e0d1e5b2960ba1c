#include "lib/film/pixel_format.h"
#include "tests/support/half_edges.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <cstring>
#include <limits>

namespace {

TEST(PixelFormat, HalvesAreTheNearest) {
    for (std::uint32_t half = 0; half < half_infinity; ++half) {
        const float exact = float_of_half(half);
        const float middle = middle_above_half(half);
        const std::uint32_t even = half + half % 2;
        ASSERT_EQ(pt::half_bits(exact), half) << exact;
        ASSERT_EQ(pt::half_bits(std::nextafter(middle, 0.0F)), half) << middle;
        ASSERT_EQ(pt::half_bits(middle), even) << middle;
        ASSERT_EQ(pt::half_bits(std::nextafter(middle, std::numeric_limits<float>::infinity())), half + 1) << middle;
    }
}

TEST(PixelFormat, HalvesAtTheEndsOfTheRange) {
    EXPECT_EQ(pt::half_bits(std::numeric_limits<float>::denorm_min()), 0U);
    EXPECT_EQ(pt::half_bits(std::numeric_limits<float>::min()), 0U);
    EXPECT_EQ(pt::half_bits(0x1p-25F), 0U);
    EXPECT_EQ(pt::half_bits(0x1.000002p-25F), 1U);
    EXPECT_EQ(pt::half_bits(65504.0F), 0x7bffU);
    EXPECT_EQ(pt::half_bits(0x1.ffdffep15F), 0x7bffU); // below 65520, the midpoint between 65504 and infinity
    EXPECT_EQ(pt::half_bits(65520.0F), half_infinity);
    EXPECT_EQ(pt::half_bits(65536.0F), half_infinity);
    EXPECT_EQ(pt::half_bits(std::numeric_limits<float>::max()), half_infinity);
    EXPECT_EQ(pt::half_bits(std::numeric_limits<float>::infinity()), half_infinity);
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
    EXPECT_EQ(pt::pixel_bytes(PT_FORMAT_RGB32F), sizeof rgb / 2);
    EXPECT_EQ(pt::pixel_bytes(PT_FORMAT_RGBA32F), sizeof rgba / 2);
    EXPECT_EQ(pt::pixel_bytes(PT_FORMAT_RGBA16F), sizeof halves / 2);
}

} // namespace
