#include "tests/support/sized.h"

#include <pt/compare.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <limits>
#include <random>
#include <string>
#include <vector>

namespace {

constexpr std::uint32_t width = 48;
constexpr std::uint32_t height = 32;
constexpr std::size_t pixel_count = std::size_t{width} * height;

using Pixels = std::vector<float>;
using Noise = std::function<double(std::mt19937 &)>;

Pixels drawn(std::mt19937 &random, const Noise &noise) {
    Pixels pixels;
    for (std::size_t i = 0; i < pixel_count; ++i)
        pixels.insert(pixels.end(), 3, static_cast<float>(noise(random)));
    return pixels;
}

Pixels times(Pixels pixels, double factor) {
    for (float &value : pixels)
        value = static_cast<float>(value * factor);
    return pixels;
}

pt_compare_info info_of(const Pixels &first, const Pixels &second) {
    auto info = sized<pt_compare_info>();
    info.width = width;
    info.height = height;
    info.first.radiance = first.data();
    info.second.radiance = second.data();
    return info;
}

pt_comparison compared(const pt_compare_info &info) {
    auto comparison = sized<pt_comparison>();
    std::uint32_t count = 0;
    EXPECT_EQ(pt_compare(&info, &comparison, nullptr, &count), PT_OK) << pt_last_error(nullptr);
    return comparison;
}

Noise normal(double deviation) {
    return [=](std::mt19937 &random) { return std::normal_distribution(1.0, deviation)(random); };
}

// Light of mean 1 from rare events. A pixel has `share` events on average.
Noise rare_events(double share) {
    return [=](std::mt19937 &random) { return std::poisson_distribution<int>(share)(random) / share; };
}

// A fraction `of_light` of the light comes from rare events.
Noise partly_rare(double share, double of_light) {
    return [=](std::mt19937 &random) {
        return (1.0 - of_light) * normal(0.001)(random) + of_light * rare_events(share)(random);
    };
}

int count_different(const Noise &first, const Noise &second, int pairs, double rate, double ratio = 1.0) {
    std::mt19937 random(7);
    int different = 0;
    for (int i = 0; i < pairs; ++i) {
        const Pixels a = drawn(random, first);
        const Pixels b = drawn(random, second);
        pt_compare_info info = info_of(a, b);
        info.rate = rate;
        info.first.min_samples = info.first.max_samples = 64;
        info.second.min_samples = info.second.max_samples = static_cast<std::uint32_t>(64 * ratio);
        different += compared(info).light == PT_LIGHT_DIFFERENT ? 1 : 0;
    }
    return different;
}

TEST(Comparison, EqualBitsAndLightWithoutNoise) {
    const Pixels ones(3 * pixel_count, 1.0F);
    EXPECT_EQ(compared(info_of(ones, ones)).light, PT_LIGHT_EQUAL_BITS);
    const Pixels rounded = times(ones, 1.0 + 9e-5);
    EXPECT_EQ(compared(info_of(rounded, ones)).light, PT_LIGHT_SAME);
    const Pixels brighter = times(ones, 1.05);
    EXPECT_EQ(compared(info_of(brighter, ones)).light, PT_LIGHT_DIFFERENT);
    EXPECT_STREQ(compared(info_of(brighter, ones)).summary, "different light: +5% +- 0.25% of the picture in R");
}

// Computes the bound of shaders/README.md, section 11, for three sizes of regions.
TEST(Comparison, TheProbabilityIsThatOfSigns) {
    std::mt19937 random(1);
    const Pixels ones(3 * pixel_count, 1.0F);
    Pixels first;
    for (std::size_t i = 0; i < pixel_count; ++i)
        first.insert(first.end(), 3, i % 8 < 3 ? 0.9F : 1.1F);
    pt_compare_info info = info_of(first, ones);
    std::uint32_t count = 1;
    pt_compared_region whole{};
    auto comparison = sized<pt_comparison>();
    ASSERT_EQ(pt_compare(&info, &comparison, &whole, &count), PT_OK);
    const double minus = 3.0 / 8.0 * static_cast<double>(pixel_count);
    const double plus = static_cast<double>(pixel_count) - minus;
    const double up = static_cast<double>(1.1F) - 1.0;
    const double down = static_cast<double>(0.9F) - 1.0;
    const double deviation = std::sqrt(plus * up * up + minus * down * down);
    const double event = std::max(up / 1.0, -down / (1.0 + down));
    const double excess = plus * up + minus * down - 1e-4 * pixel_count;
    const double by_noise = std::min(excess, deviation * deviation / event) / deviation;
    const double by_events = excess / event - by_noise * deviation / event;
    const double expected = 9.0 * 3.178 * std::erfc(by_noise / std::sqrt(2.0)) * std::exp(-by_events);
    EXPECT_NEAR(whole.probability, expected, 1e-9 * expected);
    EXPECT_LT(expected, 1e-6);
    EXPECT_EQ(count, 1U);
    EXPECT_EQ(whole.width, width);
    EXPECT_NEAR(whole.difference[1], (plus * up + minus * down) / pixel_count, 1e-12);
}

// The first image has a Poisson number of equal events, each in its own pixel, and the other image has no noise.
TEST(Comparison, TheProbabilityIsAtLeastThatOfEvents) {
    constexpr double expected = 300.0;
    const Pixels ones(3 * pixel_count, 1.0F);
    double term = std::exp(-expected);
    double tail = 0.0;
    for (int count = 0; count < 300; ++count) {
        tail += term;
        term *= expected / (count + 1);
        Pixels first(3 * pixel_count, 0.0F);
        for (std::size_t i = 0; i < static_cast<std::size_t>(count); ++i)
            std::fill_n(&first[3 * (i * 5 % pixel_count)], 3, static_cast<float>(pixel_count / expected));
        const double least = tail > 1e-9 ? std::min(tail, 0.5) : 0.0;
        EXPECT_GE(compared(info_of(first, ones)).probability, least) << count;
    }
}

TEST(Comparison, EqualLightIsHardlyEverCalledDifferent) {
    constexpr int pairs = 400;
    constexpr double rate = 0.01;
    // P(Poisson(4) > 13) < 10^-4.
    constexpr int most = 13;
    EXPECT_LE(count_different(normal(0.01), normal(0.01), pairs, rate), most);
    EXPECT_LE(count_different(normal(0.3), normal(0.01), pairs, rate), most);
    EXPECT_LE(count_different(rare_events(0.05), rare_events(0.05), pairs, rate), most);
    EXPECT_LE(count_different(rare_events(0.05), normal(0.001), pairs, rate), most);
    EXPECT_LE(count_different(rare_events(0.003), normal(0.001), pairs, rate), most);
    EXPECT_LE(count_different(partly_rare(0.01, 0.1), normal(0.001), pairs, rate), most);
    EXPECT_LE(count_different(partly_rare(0.01, 0.01), normal(0.001), pairs, rate), most);
    EXPECT_LE(count_different(partly_rare(0.001, 0.05), partly_rare(0.016, 0.05), pairs, rate, 16.0), most);
}

// The smallest change is found with a probability of 99%. At most 10 of 300 pairs then miss it, with a probability of
// 99.9%.
TEST(Comparison, TheSmallestChangeIsFound) {
    std::mt19937 random(3);
    for (const Noise &noise : {normal(0.02), normal(0.2), rare_events(3.0)}) {
        int found = 0;
        constexpr int pairs = 300;
        for (int i = 0; i < pairs; ++i) {
            const Pixels second = drawn(random, noise);
            const Pixels first = drawn(random, noise);
            const double change = compared(info_of(first, second)).smallest_change;
            ASSERT_LT(change, 0.6);
            const Pixels changed = times(first, 1.0 + change);
            found += compared(info_of(changed, second)).light == PT_LIGHT_DIFFERENT ? 1 : 0;
        }
        EXPECT_GE(found, pairs - 10);
    }
}

TEST(Comparison, TooFewSamplesAreToldFromTheSameLight) {
    std::mt19937 random(5);
    const Pixels first = drawn(random, normal(0.02));
    const Pixels second = drawn(random, normal(0.02));
    pt_compare_info info = info_of(first, second);
    const double smallest = compared(info).smallest_change;
    info.min_change = smallest * 1.01;
    EXPECT_EQ(compared(info).light, PT_LIGHT_SAME);
    EXPECT_NE(std::string(compared(info).summary).find("% of all light"), std::string::npos);
    info.min_change = smallest * 0.99;
    EXPECT_EQ(compared(info).light, PT_LIGHT_UNDECIDED);
    const Pixels black(first.size(), 0.0F);
    EXPECT_EQ(compared(info_of(black, second)).light, PT_LIGHT_UNDECIDED); // The black image may have missed the lamp.
}

// A darker image shows a difference, unless it may have missed light that the other image cannot miss.
TEST(Comparison, LackOfLightThatMayBeMissedSaysNothing) {
    std::mt19937 random(5);
    const Pixels darker = drawn(random, normal(0.02));
    const Pixels brighter = times(drawn(random, normal(0.02)), 1.1);
    pt_compare_info info = info_of(darker, brighter);
    info.first.estimator = PT_ESTIMATOR_BSDF;
    EXPECT_EQ(compared(info).light, PT_LIGHT_UNDECIDED);
    info.second.estimator = PT_ESTIMATOR_UNIFORM;
    EXPECT_EQ(compared(info).light, PT_LIGHT_DIFFERENT);
    info.first.estimator = PT_ESTIMATOR_LIGHT;
    EXPECT_EQ(compared(info).light, PT_LIGHT_DIFFERENT);
}

// The darker image may have missed samples as bright as the lamp.
TEST(Comparison, ASampleOfTheBrightestPixelMayBeMissing) {
    Pixels second(3 * pixel_count, 1.0F);
    Pixels first = times(second, 0.97);
    std::fill_n(first.begin(), 3, 1000.0F);
    std::fill_n(second.begin(), 3, 1000.0F);
    pt_compare_info info = info_of(first, second);
    for (const std::uint32_t samples : {16U, 4096U}) {
        info.first.min_samples = info.first.max_samples = samples;
        info.second.min_samples = info.second.max_samples = samples;
        EXPECT_EQ(compared(info).light == PT_LIGHT_DIFFERENT, samples == 4096U) << samples;
    }
}

TEST(Comparison, LooksShareTheRate) {
    std::mt19937 random(5);
    const Pixels second = drawn(random, normal(0.02));
    const Pixels first = times(drawn(random, normal(0.02)), 1.01);
    pt_compare_info info = info_of(first, second);
    info.rate = 0.5;
    info.rate = 3.0 * compared(info).probability;
    ASSERT_LT(info.rate, 0.5);
    for (const std::uint32_t look : {0U, 1U, 2U, 5U}) {
        info.look = look;
        const pt_comparison comparison = compared(info);
        const double shares = std::max(look * (look + 1), 1U);
        EXPECT_EQ(comparison.light == PT_LIGHT_DIFFERENT, shares <= 3) << look;
        EXPECT_DOUBLE_EQ(comparison.rate, info.rate / shares);
    }
    info.rate = 0.0;
    info.look = 0;
    EXPECT_EQ(compared(info).rate, 1e-6);
}

// The bound for k events is e^(-k / 6).
TEST(Comparison, FewPixelsWithLightSayLittle) {
    const Pixels second(3 * pixel_count, 1.0F);
    for (const std::size_t lit : {std::size_t{10}, std::size_t{100}}) {
        Pixels first(second.size(), 0.0F);
        std::fill_n(first.begin(), 3 * lit, 1.0F);
        EXPECT_GE(compared(info_of(first, second)).probability, std::exp(-static_cast<double>(lit) / 6.0)) << lit;
    }
}

TEST(Comparison, RegionsAreCounted) {
    const Pixels ones(3 * pixel_count, 1.0F);
    const pt_compare_info info = info_of(ones, ones);
    std::uint32_t count = 0;
    ASSERT_EQ(pt_compare(&info, nullptr, nullptr, &count), PT_OK);
    EXPECT_EQ(count, 6U + 2U + 1U);
    pt_compared_region region{};
    EXPECT_EQ(pt_compare(&info, nullptr, &region, &count), PT_ERROR_INVALID_ARGUMENT);
}

TEST(Comparison, WhatBreaksARuleIsRefused) {
    const Pixels ones(3 * pixel_count, 1.0F);
    Pixels wrong = ones;
    wrong[7] = std::numeric_limits<float>::infinity();
    const auto expect_refusal = [&](const std::string &message, const std::function<void(pt_compare_info &)> &change) {
        pt_compare_info info = info_of(ones, ones);
        change(info);
        auto comparison = sized<pt_comparison>();
        std::uint32_t count = 0;
        EXPECT_EQ(pt_compare(&info, &comparison, nullptr, &count), PT_ERROR_INVALID_ARGUMENT);
        EXPECT_NE(std::string(pt_last_error(nullptr)).find(message), std::string::npos) << pt_last_error(nullptr);
    };
    expect_refusal("compare.width * height = 0: must be in [1, 2^32 - 1]", [](auto &info) { info.width = 0; });
    expect_refusal("compare.rate = 0.6: must be in (0, 0.5], or 0", [](auto &info) { info.rate = 0.6; });
    expect_refusal("compare.min_change = -1: must be finite", [](auto &info) { info.min_change = -1.0; });
    expect_refusal("first.radiance = NULL", [](auto &info) { info.first.radiance = nullptr; });
    expect_refusal("second.radiance[7] = inf", [&](auto &info) { info.second.radiance = wrong.data(); });
    expect_refusal("first.max_samples = 3: must be min_samples, 0: adaptive sampling shifts the mean",
                   [](auto &info) { info.first.max_samples = 3; });
    expect_refusal("second.sampler = 2: must not be PT_SAMPLER_HALTON",
                   [](auto &info) { info.second.sampler = PT_SAMPLER_HALTON; });
}

} // namespace
