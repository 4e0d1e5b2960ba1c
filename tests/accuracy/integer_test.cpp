#include "integer_items.spv.h"
#include "shaders/specialization.h"
#include "tests/accuracy/evaluation.h"
#include "tests/accuracy/inputs.h"

#include <gtest/gtest.h>

#include <array>
#include <bit>
#include <cmath>

namespace accuracy::integer {

namespace {

struct Item {
    glm::uvec4 words;
    glm::uvec4 number;
};

struct Result {
    glm::uvec4 hash, fixed;
};

std::vector<Item> items() {
    Inputs inputs(5);
    const auto words = [&] { return glm::uvec4(inputs.word(), inputs.word(), inputs.word(), inputs.word()); };
    std::vector<Item> items;
    for (std::size_t i = 0; i < random_count; ++i) {
        Item item{words(), words()};
        item.number.x = i % 2 == 0 ? std::bit_cast<std::uint32_t>(static_cast<float>(inputs.log_uniform(1e-25, 2.6e8)))
                                   : item.number.x % std::bit_cast<std::uint32_t>(0x1p28F);
        items.push_back(item);
    }
    for (std::uint32_t bit = 0; bit < 32; ++bit)
        items.push_back({{0, 0xffffffffU, 1U << bit, ~(1U << bit)}, {1U << bit % 28, 0, 0, 0}});
    for (std::uint32_t exponent = 1; exponent < 127 + 28; ++exponent)
        for (const std::uint32_t mantissa : {0U, 1U, 0x7fffffU})
            items.push_back({words(), {exponent << 23 | mantissa, 0, 0, 0}});
    return items;
}

// One round of pcg4d (Jarzynski and Olano 2020).
void mix(std::array<std::uint32_t, 4> &v) {
    constexpr int factors[4][2] = {{1, 3}, {2, 0}, {0, 1}, {1, 2}};
    for (std::size_t i = 0; i < 4; ++i)
        v[i] += v[static_cast<std::size_t>(factors[i][0])] * v[static_cast<std::size_t>(factors[i][1])];
}

glm::uvec4 pcg4d(const glm::uvec4 &input) {
    std::array<std::uint32_t, 4> v{};
    for (int i = 0; i < 4; ++i)
        v[static_cast<std::size_t>(i)] = static_cast<std::uint32_t>(1664525ULL * input[i] + 1013904223ULL);
    mix(v);
    for (std::uint32_t &word : v)
        word = word ^ word / 65536;
    mix(v);
    return {v[0], v[1], v[2], v[3]};
}

// value * 2^60 with the least significant word first. Doubles are exact here.
glm::uvec4 fixed_point(float value) {
    glm::uvec4 words;
    double rest = std::nearbyint(std::ldexp(double{value}, 60));
    for (int word = 3; word >= 0; --word) {
        const double unit = std::ldexp(1.0, 32 * word);
        const double digit = std::floor(rest / unit);
        words[word] = static_cast<std::uint32_t>(digit);
        rest -= digit * unit;
    }
    return words;
}

struct Differences {
    std::size_t hash = 0, fixed = 0;
};

Differences differences(const std::vector<Item> &items, const std::vector<Result> &results) {
    Differences found;
    for (std::size_t i = 0; i < items.size(); ++i) {
        const auto &[words, number] = items[i];
        found.hash += results[i].hash != pcg4d(words);
        found.fixed += results[i].fixed != fixed_point(std::bit_cast<float>(number.x));
    }
    return found;
}

TEST(AccuracyIntegers, AreExact) {
    const std::vector<Item> all = items();
    std::vector<std::uint32_t> constants(pt::gpu::CONSTANT_COUNT);
    constants[pt::gpu::ID_SPHERE_COUNT] = 1;
    constants[pt::gpu::ID_POINT_BLOCKS] = probe_point_blocks;
    Probe probe(integer_items_spirv(), sizeof(ItemRange), constants);
    std::vector<Result> results = evaluate<Result>(probe, all);
    const Differences none = differences(all, results);
    EXPECT_EQ(none.hash, 0U);
    EXPECT_EQ(none.fixed, 0U);
    for (const char *function : {"pcg4d", "fixed_point"})
        std::printf("accuracy: %-28s %6zu inputs, exact\n", function, all.size());

    // Negative control: one wrong bit in each kind of result.
    results[77].hash.x ^= 1U;
    results[79].fixed.y ^= 1U << 16;
    const Differences one = differences(all, results);
    EXPECT_EQ(one.hash, 1U);
    EXPECT_EQ(one.fixed, 1U);
}

} // namespace

} // namespace accuracy::integer
