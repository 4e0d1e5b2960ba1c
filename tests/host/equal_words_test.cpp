// Equal words are found wherever they are, and others are not taken for equal.
#include "lib/tree/equal_words.h"

#include <gtest/gtest.h>

#include <cstddef>
#include <random>
#include <vector>

namespace equal_words {

namespace {

std::vector<glm::uvec4> distinct(std::size_t count) {
    std::vector<glm::uvec4> words;
    for (std::uint32_t i = 0; i < count; ++i)
        words.emplace_back(i % 64, i / 64 % 64, i / 4096, 0x3f800000); // a lattice
    return words;
}

bool has_equal(const std::vector<glm::uvec4> &words) {
    pt::WorkProgress nobody;
    return pt::has_equal_words(words, nobody);
}

TEST(EqualWords, AreNotSeenInALattice) {
    for (const std::size_t count : {0U, 1U, 2U, 31U, 32U, 33U, 1000U, 300'000U})
        EXPECT_FALSE(has_equal(distinct(count))) << count;
}

TEST(EqualWords, AreFoundAnywhere) {
    std::mt19937 engine(3);
    for (int trial = 0; trial < 200; ++trial) {
        const std::size_t count = 2 + engine() % 5000;
        std::vector<glm::uvec4> words = distinct(count);
        const std::size_t from = engine() % count;
        const std::size_t to = (from + 1 + engine() % (count - 1)) % count;
        words[to] = words[from];
        EXPECT_TRUE(has_equal(words)) << from << " and " << to << " of " << count;
    }
    EXPECT_TRUE(has_equal(std::vector<glm::uvec4>(100'000, glm::uvec4(7))));
}

// A word that differs from another in any one bit is another.
TEST(EqualWords, DifferByABit) {
    std::vector<glm::uvec4> words{glm::uvec4(1, 2, 3, 4)};
    for (int component = 0; component < 4; ++component)
        for (int bit = 0; bit < 32; ++bit) {
            words.push_back(words.front());
            words.back()[component] ^= 1U << bit;
        }
    EXPECT_FALSE(has_equal(words));
    words.push_back(words[77]);
    EXPECT_TRUE(has_equal(words));
}

} // namespace

} // namespace equal_words
