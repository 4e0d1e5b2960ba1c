#include "lib/code/shader_source.h"
#include "lib/film/pixel_format.h"
#include "lib/kernel/resolve_to_buffer.h"
#include "lib/kernel/resolve_to_host.h"
#include "tests/film/film_words.h"
#include "tests/film/random_sums.h"
#include "tests/support/expected_error.h"
#include "tests/support/half_edges.h"
#include "tests/vulkan/device_fixture.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <tuple>
#include <vector>

namespace {

constexpr int fraction_bits = static_cast<int>(pt::gpu::FILM_FRACTION_BITS);

constexpr pt::PartCounts parts_of_100{100, 100};

class Resolve : public VulkanFixture {
protected:
    static constexpr std::uint32_t width = 500;
    static constexpr std::uint32_t height = 200;

    void SetUp() override {
        VulkanFixture::SetUp();
        device_with(pt::vulkan::gpu_like_policy());
    }

    std::vector<std::byte> read(pt::DeviceFilm &film, const pt::ImageQuery &query) {
        std::vector<std::byte> bytes;
        pt::ResolveToHost(device(), pipelines(), film).read(query, [&](std::span<const std::byte> piece) {
            bytes.insert(bytes.end(), piece.begin(), piece.end());
        });
        return bytes;
    }

    pt::ResolvePipelines &pipelines() {
        if (!pipelines_)
            pipelines_.emplace(device(), pt::embedded_code().resolve);
        return *pipelines_;
    }

    void TearDown() override {
        pipelines_.reset();
        VulkanFixture::TearDown();
    }

private:
    std::optional<pt::ResolvePipelines> pipelines_;
};

TEST_F(Resolve, BitsAreThoseOfTheHost) {
    pt::DeviceFilm film(device(), width, height, 30'000);
    const pt::PixelSums sums = film_of(RandomSums().pixels(std::size_t{width} * height));
    fill(device(), film, sums);
    for (const double unit : {1.0, 0x1p-100, 0x1p110})
        for (const std::uint32_t quantity : {PT_QUANTITY_RADIANCE, PT_QUANTITY_STANDARD_ERROR}) {
            const std::vector<std::byte> found = read(film, {{0, 0, width, height}, quantity, unit, parts_of_100});
            const std::vector<float> expected = sums.values(quantity, unit);
            ASSERT_TRUE(std::ranges::equal(found, std::as_bytes(std::span(expected)))) << quantity << ", " << unit;
        }
}

TEST_F(Resolve, FormatsAreThoseOfTheHost) {
    std::vector<float> numbers = {65536.0F, 1e9F, 0x1p-40F};
    for (std::uint32_t half = 0; half < half_infinity; ++half) {
        const float middle = middle_above_half(half);
        for (const float number :
             {float_of_half(half), std::nextafter(middle, 0.0F), middle, std::nextafter(middle, 1e9F)})
            numbers.push_back(number);
    }
    numbers.resize(3 * std::size_t{width} * height);
    constexpr int exponent = -60;
    std::vector<ResolvedPixel> pixels(std::size_t{width} * height);
    for (std::size_t i = 0; i < numbers.size(); ++i)
        pixels[i / 3].parts[0].sums[i % 3] = static_cast<pt::WideSum>(std::ldexp(numbers[i], -exponent));
    for (ResolvedPixel &pixel : pixels)
        pixel.parts[0].accepted = 1;
    const pt::PixelSums sums = film_of(pixels);
    pt::DeviceFilm film(device(), width, height, 30'000);
    fill(device(), film, sums);
    pt::ImageQuery query{
        {0, 0, width, height}, PT_QUANTITY_RADIANCE, std::ldexp(1.0, exponent + fraction_bits), parts_of_100};
    for (const std::uint32_t format : {PT_FORMAT_RGB32F, PT_FORMAT_RGBA32F, PT_FORMAT_RGBA16F})
        for (const std::uint32_t quantity : {PT_QUANTITY_RADIANCE, PT_QUANTITY_STANDARD_ERROR}) {
            query.quantity = quantity;
            query.format = format;
            const std::vector<float> values = quantity == PT_QUANTITY_STANDARD_ERROR
                                                  ? std::vector(numbers.size(), std::numeric_limits<float>::infinity())
                                                  : numbers;
            std::vector<std::byte> expected(pixels.size() * pt::pixel_bytes(format));
            pt::write_pixels(values, format, expected.data());
            ASSERT_TRUE(read(film, query) == expected) << "format " << format;
        }
}

TEST_F(Resolve, BuffersHoldTheImageAndNothingElse) {
    constexpr std::uint32_t wide = 101;
    constexpr std::uint32_t high = 60;
    pt::DeviceFilm film(device(), wide, high, 991);
    fill(device(), film, film_of(RandomSums().pixels(std::size_t{wide} * high)));
    pt::vulkan::Buffer buffer(device(), pt::vulkan::BufferUse::Storage, 200'000, "test");
    const std::vector<std::byte> guards(buffer.size(), std::byte{0xa5});
    const auto large = pt::ResolveToBuffer::piece_limits(device().limits());
    EXPECT_GE(large.pixels, 1U << 21);
    EXPECT_LE(large.pixels * 16, device().limits().max_storage_buffer_range);
    for (const auto &limits : {large, {500, large.bytes}, {large.pixels, 4000}, {50, 800}, {large.pixels, 16}}) {
        pt::ResolveToBuffer writer(device(), pipelines(), film, limits);
        for (const std::uint32_t format : {PT_FORMAT_RGB32F, PT_FORMAT_RGBA32F, PT_FORMAT_RGBA16F})
            for (const auto &[part, offset, gap] : {std::tuple(pt::Rectangle{0, 0, wide, high}, 0U, 0U),
                                                    {{0, 0, wide, high}, 4U, 12U},
                                                    {{100, 59, 1, 1}, 199'984U, 400U},
                                                    {{17, 3, 61, 41}, 100'300U, 68U}}) {
                const pt::ImageQuery query{part, PT_QUANTITY_RADIANCE, 1.0, parts_of_100, format};
                const std::uint64_t row = std::uint64_t{part.width} * pt::pixel_bytes(format);
                const std::vector<std::byte> image = read(film, query);
                std::vector<std::byte> expected = guards;
                for (std::uint32_t y = 0; y < part.height; ++y)
                    std::ranges::copy(std::span(image).subspan(y * row, row),
                                      expected.begin() + static_cast<std::ptrdiff_t>(offset + y * (row + gap)));
                buffer.upload(guards, 0);
                writer.write(query, {buffer.handle(), offset, row + gap, {}});
                std::vector<std::byte> found(buffer.size());
                buffer.download(found, 0);
                ASSERT_TRUE(found == expected) << "format " << format << ", offset " << offset << ", pieces of "
                                               << limits.pixels << " pixels and " << limits.bytes << " bytes";
            }
    }
}

// The first call after the loss reports it and writes nothing.
TEST_F(Resolve, SamplesLostOnTheWayToABufferAreAnError) {
    pt::DeviceFilm film(device(), width, height, 30'000);
    const std::vector<ResolvedPixel> pixels(std::size_t{width} * height, ResolvedPixel{{{{}, 100}, {{}, 100}}});
    pt::PixelSums sums = film_of(pixels);
    sums.plane(1, pt::gpu::FILM_ACCEPTED)[7] = 99;
    fill(device(), film, sums);
    pt::vulkan::Buffer buffer(device(), pt::vulkan::BufferUse::Storage, pixels.size() * 12, "test");
    const vk::raii::Semaphore semaphore = device().handle().createSemaphore({});
    const pt::ImageQuery query{{0, 0, width, height}, PT_QUANTITY_RADIANCE, 1.0, parts_of_100};
    const pt::ImageQuery of_one{{0, 0, 1, 1}, PT_QUANTITY_RADIANCE, 1.0, parts_of_100};
    pt::ResolveToBuffer writer(device(), pipelines(), film, pt::ResolveToBuffer::piece_limits(device().limits()));
    const char *const lost = "the driver lost samples of 1 pixels";
    EXPECT_STREQ(error_of([&] { writer.write(query, {buffer.handle(), 0, width * 12, {}}); }).what(), lost);
    writer.write(of_one, {buffer.handle(), 0, width * 12, {}});
    writer.write(query, {buffer.handle(), 0, width * 12, {.wait = {}, .signal = *semaphore}});
    const pt::Error error = error_of([&] { writer.write(of_one, {buffer.handle(), 0, width * 12, {}}); });
    EXPECT_EQ(error.code(), PT_ERROR_INTERNAL);
    EXPECT_STREQ(error.what(), lost);
    writer.write(of_one, {buffer.handle(), 0, width * 12, {}});
}

TEST_F(Resolve, LostSamplesAreAnError) {
    constexpr std::uint32_t high = 1200;
    pt::DeviceFilm film(device(), width, high, 500'000);
    const pt::PixelSums whole = film_of(std::vector(std::size_t{width} * high, ResolvedPixel{{{{}, 100}, {{}, 100}}}));
    pt::PixelSums damaged = whole;
    damaged.plane(1, pt::gpu::FILM_ACCEPTED)[5] = 99;
    damaged.plane(0, pt::gpu::FILM_REJECTED)[99'999] = 1;
    const auto read_sums = [&](const pt::PixelSums &sums) {
        fill(device(), film, sums);
        read(film, {{0, 0, width, high}, PT_QUANTITY_RADIANCE, 1.0, parts_of_100});
    };
    for (int again = 0; again < 3; ++again) {
        read_sums(whole);
        const pt::Error error = error_of([&] { read_sums(damaged); });
        EXPECT_EQ(error.code(), PT_ERROR_INTERNAL);
        EXPECT_STREQ(error.what(), "the driver lost samples of 2 pixels");
    }
}

} // namespace
