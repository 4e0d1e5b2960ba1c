// Exact sums: the device's fixed-point additions against sums of the same floats in wider integers on the host.
#include "film.h"

#include "error.h"
#include "film_sums.spv.h"
#include "probe.h"

#include <gtest/gtest.h>

#include <bit>
#include <cmath>
#include <limits>
#include <random>
#include <vector>

namespace {

__extension__ using Wide = unsigned __int128;

constexpr std::uint32_t pixels = 1000;
constexpr std::uint32_t per_pixel = 40;

// A float as a multiple of 2^-64, finer bits cut off: by integer arithmetic on the mantissa that frexp gives.
Wide multiple_of_2_to_minus_64(float value) {
    int exponent = 0;
    const auto mantissa = static_cast<std::uint64_t>(std::ldexp(std::frexp(value, &exponent), 24));
    const int shift = exponent - 24 + 64;
    return shift >= 0 ? Wide{mantissa} << shift : shift > -64 ? Wide{mantissa} >> -shift : 0;
}

bool acceptable(const glm::vec4 &sample) {
    bool good = true;
    for (int channel = 0; channel < 3; ++channel)
        good = good && sample[channel] >= 0.0F && sample[channel] < 0x1p28F;
    return good;
}

// Samples over the whole range, with exact powers of two, zeros, denormals and unacceptable ones among them.
std::vector<glm::vec4> awkward_samples() {
    std::mt19937 generator(1);
    std::uniform_real_distribution<float> exponent(-60.0F, 28.0F);
    std::uniform_int_distribution<int> kind(0, 19);
    const float special[] = {0.0F,
                             -0.0F,
                             0x1p-149F,
                             0x1p-126F,
                             0x1p-64F,
                             0x1p-65F,
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
    return samples;
}

std::uint32_t word(const std::vector<std::uint32_t> &film, std::size_t plane, std::size_t pixel) {
    return film[plane * pixels + pixel];
}

TEST(Film, DeviceSumsAreExact) {
    struct {
        std::uint32_t per_pixel, count;
    } push{per_pixel, pixels};
    const std::vector<glm::vec4> samples = awkward_samples();
    Probe probe(film_sums_spirv, sizeof push);
    std::vector<std::uint32_t> film = probe.run<std::uint32_t>(samples, pixels * pt::gpu::FILM_WORDS, push, pixels);

    for (std::uint32_t pixel = 0; pixel < pixels; ++pixel) {
        Wide sums[3] = {};
        std::uint32_t accepted = 0;
        for (std::uint32_t i = 0; i < per_pixel; ++i) {
            const glm::vec4 &sample = samples[pixel * per_pixel + i];
            if (!acceptable(sample))
                continue;
            ++accepted;
            for (int channel = 0; channel < 3; ++channel)
                sums[channel] += multiple_of_2_to_minus_64(sample[channel]);
        }
        ASSERT_EQ(word(film, pt::gpu::FILM_ACCEPTED, pixel), accepted);
        ASSERT_EQ(word(film, pt::gpu::FILM_REJECTED, pixel), per_pixel - accepted);
        for (std::size_t channel = 0; channel < 3; ++channel)
            for (std::size_t i = 0; i < 4; ++i)
                ASSERT_EQ(word(film, 4 * channel + i, pixel), static_cast<std::uint32_t>(sums[channel] >> (32 * i)))
                    << "pixel " << pixel << " channel " << channel << " word " << i;
    }
}

TEST(Film, SumOfWordsIsTheFixedPointValue) {
    const std::uint32_t half[4] = {0, 0x80000000U, 0, 0};
    const std::uint32_t one[4] = {0, 0, 1, 0};
    const std::uint32_t large[4] = {0, 0, 0, 0x10000000U};
    const std::uint32_t smallest[4] = {1, 0, 0, 0};
    EXPECT_EQ(pt::sum_of_words(half), 0.5);
    EXPECT_EQ(pt::sum_of_words(one), 1.0);
    EXPECT_EQ(pt::sum_of_words(large), 0x1p60);
    EXPECT_EQ(pt::sum_of_words(smallest), 0x1p-64);
}

// Film words of one pixel whose red sum is the given number of units.
std::vector<std::uint32_t> film_pixel(std::uint32_t red, std::uint32_t accepted, std::uint32_t rejected) {
    std::vector<std::uint32_t> words(pt::gpu::FILM_WORDS);
    words[2] = red;
    words[pt::gpu::FILM_ACCEPTED] = accepted;
    words[pt::gpu::FILM_REJECTED] = rejected;
    return words;
}

TEST(Film, MeanIsOverAcceptedSamplesInRadianceUnits) {
    float radiance[3] = {-1, -1, -1};
    pt::mean_radiance(film_pixel(9, 3, 1), 1, 0.25, 4, radiance);
    EXPECT_EQ(radiance[0], 0.75F);
    EXPECT_EQ(radiance[1], 0.0F);
    pt::mean_radiance(film_pixel(0, 0, 4), 1, 0.25, 4, radiance);
    EXPECT_EQ(radiance[0], 0.0F);
}

TEST(Film, LostSamplesAreAnError) {
    float radiance[3];
    try {
        pt::mean_radiance(film_pixel(9, 3, 0), 1, 1.0, 4, radiance);
        FAIL() << "a lost sample went unnoticed";
    } catch (const pt::Error &error) {
        EXPECT_EQ(error.code(), PT_ERROR_INTERNAL);
        EXPECT_STREQ(error.what(), "the driver did 3 of 4 samples of a pixel");
    }
}

} // namespace
