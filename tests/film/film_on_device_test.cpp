#include "lib/kernel/device_film.h"

#include "film_sums.spv.h"
#include "tests/kernel/probe.h"
#include "tests/vulkan/device_fixture.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <random>
#include <span>
#include <vector>

namespace {

__extension__ using Wide = unsigned __int128;

constexpr std::uint32_t pixels = 1000;
constexpr std::uint32_t per_pixel = 40;

Wide multiple_of_2_to_minus_60(float value) {
    return static_cast<Wide>(std::nearbyint(std::ldexp(double{value}, 60)));
}

bool acceptable(const glm::vec4 &sample) {
    bool good = true;
    for (int channel = 0; channel < 3; ++channel)
        good = good && !std::signbit(sample[channel]) && sample[channel] < 0x1p28F;
    return good;
}

std::vector<glm::vec4> awkward_samples() {
    std::mt19937 generator(1);
    std::uniform_real_distribution<float> exponent(-60.0F, 28.0F);
    std::uniform_int_distribution<int> kind(0, 19);
    const float special[] = {0.0F,
                             -0.0F,
                             0x1p-149F,
                             0x1p-126F,
                             0x1p-60F,
                             0x1p-61F,
                             0x1.8p-60F,
                             0x1p27F,
                             0x1.fffffep27F,
                             0x1p28F,
                             -1.0F,
                             std::numeric_limits<float>::infinity(),
                             std::numeric_limits<float>::quiet_NaN()};
    std::vector<glm::vec4> samples(pixels * per_pixel);
    for (glm::vec4 &sample : samples)
        for (int channel = 0; channel < 3; ++channel)
            sample[channel] =
                kind(generator) == 0 ? special[generator() % std::size(special)] : std::exp2(exponent(generator));
    std::fill_n(samples.begin(), per_pixel, glm::vec4(0x1.fffffep27F));
    return samples;
}

std::uint32_t word(const std::vector<std::uint32_t> &film, std::size_t plane, std::size_t pixel) {
    return film[(pt::gpu::FILM_WORDS + plane) * pixels + pixel];
}

TEST(Film, DeviceSumsAreExact) {
    struct {
        std::uint32_t per_pixel, count, film_part;
    } push{per_pixel, pixels, 1};
    const std::vector<glm::vec4> samples = awkward_samples();
    Probe probe(film_sums_spirv(), sizeof push);
    const std::vector<std::uint32_t> film =
        probe.run<std::uint32_t>(samples, pixels * pt::film_planes(false), push, pixels);
    EXPECT_TRUE(std::all_of(film.begin(), film.begin() + pixels * pt::gpu::FILM_WORDS,
                            [](std::uint32_t value) { return value == 0; }));

    for (std::uint32_t pixel = 0; pixel < pixels; ++pixel) {
        Wide sums[3] = {};
        std::uint32_t accepted = 0;
        for (std::uint32_t i = 0; i < per_pixel; ++i) {
            const glm::vec4 &sample = samples[pixel * per_pixel + i];
            if (!acceptable(sample))
                continue;
            ++accepted;
            for (int channel = 0; channel < 3; ++channel)
                sums[channel] += multiple_of_2_to_minus_60(sample[channel]);
        }
        ASSERT_EQ(word(film, pt::gpu::FILM_ACCEPTED, pixel), accepted);
        ASSERT_EQ(word(film, pt::gpu::FILM_REJECTED, pixel), per_pixel - accepted);
        for (std::size_t channel = 0; channel < 3; ++channel)
            for (std::size_t i = 0; i < 4; ++i)
                ASSERT_EQ(word(film, 4 * channel + i, pixel), static_cast<std::uint32_t>(sums[channel] >> (32 * i)))
                    << "pixel " << pixel << " channel " << channel << " word " << i;
    }
}

TEST(Film, WindowsHoldTheMostSamplesThatAnInvocationGathers) {
    struct {
        std::uint32_t per_pixel, count, film_part;
    } push{pt::gpu::FILM_MAX_GATHERED, 4, 0};
    const float extremes[] = {0x1.fffffep27F, 0x1.fffffp4F, 0x1.00001p5F, 0x1.fffffep-18F};
    std::vector<glm::vec4> samples;
    for (const float extreme : extremes)
        samples.insert(samples.end(), push.per_pixel, glm::vec4(extreme));
    const auto film = Probe(film_sums_spirv(), sizeof push)
                          .run<std::uint32_t>(samples, push.count * pt::film_planes(false), push, push.count);
    for (std::uint32_t pixel = 0; pixel < push.count; ++pixel) {
        const Wide sum = push.per_pixel * multiple_of_2_to_minus_60(extremes[pixel]);
        for (std::size_t i = 0; i < 4; ++i)
            EXPECT_EQ(film[i * push.count + pixel], static_cast<std::uint32_t>(sum >> (32 * i))) << extremes[pixel];
    }
}

struct Part {
    std::uint32_t red;
    std::uint32_t accepted;
    std::uint32_t rejected;
};

pt::PixelSums one_pixel(const Part &older, const Part &newer) {
    pt::PixelSums sums;
    sums.resize(1);
    const auto set = [&](const Part &part, pt::FilmPart index) {
        for (std::size_t plane = 0; plane < pt::gpu::FILM_WORDS; ++plane)
            sums.plane(index, plane)[0] = 0;
        const std::uint64_t sum = std::uint64_t{part.red} << (pt::gpu::FILM_FRACTION_BITS - 32);
        sums.plane(index, 1)[0] = static_cast<std::uint32_t>(sum);
        sums.plane(index, 2)[0] = static_cast<std::uint32_t>(sum >> 32);
        sums.plane(index, pt::gpu::FILM_ACCEPTED)[0] = part.accepted;
        sums.plane(index, pt::gpu::FILM_REJECTED)[0] = part.rejected;
    };
    set(older, pt::older_part);
    set(newer, pt::newer_part);
    return sums;
}

TEST(Film, SumsThatNoSamplesHaveAreSeen) {
    EXPECT_TRUE(one_pixel({9, 1, 0}, {0, 0, 1}).holds({1, 1}));
    EXPECT_FALSE(one_pixel({9, 1, 0}, {0, 0, 1}).holds({1, 2}));
    EXPECT_FALSE(one_pixel({9, 0, 1}, {0, 0, 1}).holds({1, 1})) << "light without accepted samples";
    pt::PixelSums bright = one_pixel({0, 3, 0}, {0, 1, 0});
    bright.plane(pt::older_part, 2)[0] = 3U << (pt::gpu::FILM_MAX_EXPONENT + pt::gpu::FILM_FRACTION_BITS - 64);
    EXPECT_TRUE(bright.holds({3, 1}));
    bright.plane(pt::older_part, 0)[0] = 1;
    EXPECT_FALSE(bright.holds({3, 1}));
}

using FilmStrips = VulkanFixture;

TEST_F(FilmStrips, AreReadAsOne) {
    constexpr std::uint32_t film_pixels = 16;
    pt::DeviceFilm film(device(), 4, 4, 6);
    ASSERT_EQ(film.strips().size(), 3U);
    for (pt::DeviceFilm::Strip &strip : film.strips()) {
        std::vector<std::uint32_t> words;
        for (std::uint32_t plane = 0; plane < pt::film_planes(false); ++plane)
            for (std::uint32_t i = 0; i < strip.pixel_count; ++i)
                words.push_back(100 * plane + strip.first_pixel + i);
        strip.words.upload(std::as_bytes(std::span(words)), 0);
    }
    for (std::uint32_t first = 0; first < film_pixels; ++first)
        for (std::uint32_t count = 1; first + count <= film_pixels; ++count) {
            pt::PixelSums sums;
            sums.resize(count);
            film.read(first, sums);
            for (std::uint32_t plane = 0; plane < pt::film_planes(false); ++plane)
                for (std::uint32_t i = 0; i < count; ++i)
                    ASSERT_EQ(sums.plane(plane / pt::gpu::FILM_WORDS, plane % pt::gpu::FILM_WORDS)[i],
                              100 * plane + first + i)
                        << first << ", " << count;
        }
}

} // namespace
