// Words of a part of the film added to others, and taken off again, against sums in wider integers.
#include "lib/film/part_words.h"

#include "lib/film/quotient.h"
#include "shaders/gpu_layout.h"

#include <gtest/gtest.h>

#include <cstddef>
#include <cstdint>
#include <random>
#include <vector>

namespace {

constexpr std::size_t pixel_count = 600; // more than are added at a time
constexpr std::size_t stride = 611;

// Of one part; words of all ones and of zeros, which carries pass through and begin at, are as likely as others.
std::vector<std::uint32_t> random_words(std::uint32_t seed) {
    std::mt19937 random(seed);
    std::vector<std::uint32_t> words(pt::gpu::FILM_WORDS * stride);
    for (std::uint32_t &word : words) {
        const auto kind = random() % 3;
        word = kind == 0 ? 0U : kind == 1 ? UINT32_MAX : static_cast<std::uint32_t>(random());
    }
    return words;
}

pt::WideSum sum_of(const std::vector<std::uint32_t> &words, std::size_t channel, std::size_t pixel) {
    pt::WideSum sum = 0;
    for (std::size_t i = pt::gpu::FILM_SUM_WORDS; i-- > 0;)
        sum = sum << 32 | words[(channel * pt::gpu::FILM_SUM_WORDS + i) * stride + pixel];
    return sum;
}

class PartWords : public testing::Test {
protected:
    const std::vector<std::uint32_t> first_ = random_words(1);
    const std::vector<std::uint32_t> second_ = random_words(2);
    std::vector<std::uint32_t> sum_ = first_;

    void SetUp() override { pt::add_words({sum_.data(), stride}, {second_.data(), stride}, pixel_count); }
};

TEST_F(PartWords, AddAsNumbersOfAllWords) {
    std::size_t carries_to_the_last = 0;
    for (std::size_t pixel = 0; pixel < pixel_count; ++pixel) {
        for (std::size_t channel = 0; channel < 3; ++channel) {
            ASSERT_TRUE(sum_of(sum_, channel, pixel) ==
                        sum_of(first_, channel, pixel) + sum_of(second_, channel, pixel))
                << pixel << ", " << channel;
            const std::size_t last = ((channel + 1) * pt::gpu::FILM_SUM_WORDS - 1) * stride + pixel;
            carries_to_the_last += sum_[last] - first_[last] - second_[last];
        }
        for (const std::size_t count : {pt::gpu::FILM_ACCEPTED, pt::gpu::FILM_REJECTED}) {
            const std::size_t word = count * stride + pixel;
            ASSERT_EQ(sum_[word], first_[word] + second_[word]) << "of its own";
        }
    }
    EXPECT_GT(carries_to_the_last, pixel_count) << "what has no carries says nothing about them";
}

TEST_F(PartWords, LeaveOtherPixelsAlone) {
    for (std::size_t plane = 0; plane < pt::gpu::FILM_WORDS; ++plane)
        for (std::size_t pixel = pixel_count; pixel < stride; ++pixel)
            ASSERT_EQ(sum_[plane * stride + pixel], first_[plane * stride + pixel]) << plane << ", " << pixel;
}

TEST_F(PartWords, AreTakenOffAgain) {
    pt::subtract_words({sum_.data(), stride}, {second_.data(), stride}, pixel_count);
    EXPECT_TRUE(sum_ == first_);
}

} // namespace
