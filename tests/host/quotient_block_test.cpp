// Quotients of eight pixels at once: they equal those of quotient.h, which other tests compare with exact ones.
#include "lib/film/quotient_block.h"

#include "lib/film/quotient.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <random>
#include <utility>

namespace quotient_blocks {

namespace {

using Words = std::array<std::uint32_t, pt::gpu::FILM_SUM_WORDS * pt::block_pixels>;
using Sums = std::array<pt::WideSum, pt::block_pixels>;

Words words_of(const Sums &sums) {
    Words words{};
    for (std::size_t plane = 0; plane < pt::gpu::FILM_SUM_WORDS; ++plane)
        for (std::size_t i = 0; i < pt::block_pixels; ++i)
            words[plane * pt::block_pixels + i] = static_cast<std::uint32_t>(sums[i] >> (32 * plane));
    return words;
}

struct Counts {
    std::uint32_t a;
    std::uint32_t b;
};

// Among them sums of few bits, whose quotients often lie in the middle of two floats, parts with equal means, close
// sums, and none.
class RandomSums {
public:
    RandomSums(const Counts &counts, int most_bits) : counts_(counts), most_bits_(most_bits) {}

    std::pair<Sums, Sums> next() {
        std::pair<Sums, Sums> sums{};
        for (std::size_t i = 0; i < pt::block_pixels; ++i) {
            sums.first[i] = sum();
            sums.second[i] = random_() % 4 == 0 ? sums.first[i] + random_() % 3 : sum();
            const pt::WideSum mean = random_() % (1U << 25) | 1U;
            if (random_() % 4 == 0 && mean * std::max(counts_.a, counts_.b) >> (most_bits_ - 1) <= 1)
                sums = with_means(sums, i, mean);
        }
        return sums;
    }

private:
    std::pair<Sums, Sums> with_means(std::pair<Sums, Sums> sums, std::size_t i, pt::WideSum mean) {
        sums.first[i] = mean * counts_.a;
        sums.second[i] = mean * counts_.b;
        return sums;
    }

    pt::WideSum sum() {
        const int bits = static_cast<int>(random_() % static_cast<std::uint64_t>(most_bits_ + 1));
        const int few = random_() % 2 == 0 ? 26 : 128; // of these the leading ones stay
        const pt::WideSum number = (pt::WideSum{random_()} << 64 | random_()) >> (128 - std::max(bits, 1));
        const int cut = std::max(bits - few, 0);
        return bits == 0 ? 0 : number >> cut << cut;
    }

    Counts counts_;
    int most_bits_;
    std::mt19937_64 random_{9};
};

// Compares all floats that are known for sure, and returns how many are not.
std::size_t doubts_of(const Counts &counts, int exponent, int most_bits) {
    const pt::BlockQuotients quotients(counts.a, counts.b, exponent);
    const pt::PartWeights weights(counts.a, counts.b);
    RandomSums random(counts, most_bits);
    std::size_t doubts = 0;
    for (int i = 0; i < 2000; ++i) {
        const auto [sums_a, sums_b] = random.next();
        const Words a = words_of(sums_a);
        const Words b = words_of(sums_b);
        pt::BlockEstimates found{};
        const auto in_doubt = quotients.estimates({a.data(), pt::block_pixels}, {b.data(), pt::block_pixels}, found);
        pt::BlockFloats means{};
        const auto mean_in_doubt = quotients.means({a.data(), pt::block_pixels}, {b.data(), pt::block_pixels}, means);
        EXPECT_EQ(pt::has_any(in_doubt), in_doubt != pt::BlockDoubts{});
        for (std::size_t pixel = 0; pixel < pt::block_pixels; ++pixel) {
            const float mean = pt::mean_of(sums_a[pixel] + sums_b[pixel], counts.a + counts.b, exponent);
            EXPECT_TRUE(mean_in_doubt[pixel] != 0 || means[pixel] == mean);
            if (in_doubt[pixel] != 0) {
                ++doubts;
                continue;
            }
            const pt::PartDifference parts = weights.difference(sums_a[pixel], sums_b[pixel], exponent);
            EXPECT_EQ(found.mean[pixel], mean);
            EXPECT_EQ(found.standard_error[pixel], parts.standard_error);
            EXPECT_EQ(found.lesser[pixel], parts.first_is_less ? pt::mean_of(sums_a[pixel], counts.a, exponent)
                                                               : pt::mean_of(sums_b[pixel], counts.b, exponent));
        }
    }
    return doubts;
}

constexpr std::size_t all = 2000 * pt::block_pixels;

TEST(QuotientBlock, HasTheFloatsOfSingleQuotients) {
    for (const auto &[a, b] : {Counts{8, 8}, Counts{32, 8}, Counts{16, 12}, Counts{4096, 4096}, Counts{5, 11},
                               Counts{49, 49}, Counts{1U << 31, 1U << 30}})
        EXPECT_LT(doubts_of({a, b}, -60, 84), all / 4) << a << " " << b;
    EXPECT_LT(doubts_of({1, 1U << 20}, -60, 64), all / 4) << "the largest weight, of two words";
}

// Powers of two lose nothing, so that the middle of two floats is known to be one.
TEST(QuotientBlock, AreInNoDoubtOfExactMiddles) {
    EXPECT_EQ(doubts_of({8, 8}, -60, 52), 0U);
    EXPECT_EQ(doubts_of({4096, 4096}, -60, 52), 0U);
}

TEST(QuotientBlock, LeavesTheUnusualToSingleQuotients) {
    EXPECT_EQ(doubts_of({8, 8}, -190, 70), all);             // subnormal numbers
    EXPECT_EQ(doubts_of({8, 8}, 190, 70), all);              // and those above all floats
    EXPECT_EQ(doubts_of({1, (1U << 20) + 1}, -60, 70), all); // weights whose products are not exact
    EXPECT_GT(doubts_of({8, 8}, -60, 128), all / 8);         // long sums
    EXPECT_GT(doubts_of({8, 1U << 19}, -60, 84), all / 8);   // or long with their weights
}

} // namespace

} // namespace quotient_blocks
