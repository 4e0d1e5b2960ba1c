#include "lib/kernel/device_film.h"

#include "film_sums.spv.h"
#include "tests/film/film_words.h"
#include "tests/film/random_sums.h"
#include "tests/kernel/probe.h"
#include "tests/vulkan/device_fixture.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <random>
#include <vector>

namespace {

constexpr std::uint32_t pixels = 1000;
constexpr std::uint32_t per_pixel = 40;

pt::WideSum multiple_of_2_to_minus_60(float value) {
    return static_cast<pt::WideSum>(std::nearbyint(std::ldexp(double{value}, 60)));
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
        pt::WideSum sums[3] = {};
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
        const pt::WideSum sum = push.per_pixel * multiple_of_2_to_minus_60(extremes[pixel]);
        for (std::size_t i = 0; i < 4; ++i)
            EXPECT_EQ(film[i * push.count + pixel], static_cast<std::uint32_t>(sum >> (32 * i))) << extremes[pixel];
    }
}

using FilmStrips = VulkanFixture;

TEST_F(FilmStrips, AreReadAsOne) {
    constexpr std::uint32_t film_pixels = 16;
    pt::DeviceFilm film(device(), 4, 4, 6);
    ASSERT_EQ(film.strips().size(), 3U);
    const pt::PixelSums whole = film_of(RandomSums().pixels(film_pixels));
    fill(device(), film, whole);
    for (std::uint32_t first = 0; first < film_pixels; ++first)
        for (std::uint32_t count = 1; first + count <= film_pixels; ++count) {
            pt::PixelSums expected;
            pt::PixelSums found;
            expected.resize(count);
            found.resize(count);
            expected.copy(whole, first, count, 0);
            film.read(first, found);
            ASSERT_TRUE(found == expected) << first << ", " << count;
        }
}

} // namespace
