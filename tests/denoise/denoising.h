// Two noisy halves of a picture with known limits, denoised by the library that CMake names.
#pragma once

#include <pt/denoise.h>
#include <pt/pt.h>

#include <gtest/gtest.h>

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <functional>
#include <random>
#include <utility>
#include <vector>

using Pixels = std::vector<float>;

inline constexpr std::uint32_t width = 192;
inline constexpr std::uint32_t height = 160;
inline constexpr double much_noise = 0.7;
inline constexpr std::size_t value_count = std::size_t{3} * width * height;

inline double limit_at(std::size_t index) {
    return 0.6 + 0.4 * static_cast<double>(index / 3 % width / 12 % 2) + 0.1 * static_cast<double>(index % 3);
}

// `deviation` is relative to the mean.
inline Pixels noisy(std::uint64_t seed, double deviation) {
    std::mt19937_64 random(seed);
    Pixels pixels(value_count);
    for (std::size_t i = 0; i < value_count; ++i) {
        const double uniform = (static_cast<double>(random() >> 11) + 0.5) * 0x1p-53;
        pixels[i] = static_cast<float>(limit_at(i) * (1.0 + deviation * (-std::log(uniform) - 1.0)));
    }
    return pixels;
}

struct Denoising {
    explicit Denoising(Pixels first_half, Pixels second_half) :
        first(std::move(first_half)),
        second(std::move(second_half)) {
        error.struct_size = sizeof error;
        info.struct_size = sizeof info;
        info.width = width;
        info.height = height;
        info.first = first.data();
        info.second = second.data();
        info.albedo = info.normal = guide.data();
        info.denoised = denoised.data();
        info.library = PT_TEST_OPEN_IMAGE_DENOISE;
    }

    Denoising(std::uint64_t seed, double deviation) :
        Denoising(noisy(2 * seed, deviation), noisy(2 * seed + 1, deviation)) {}

    pt_result run(const char *wish = "") {
        setenv("FAKE_OIDN", wish, 1);
        return pt_denoise(&info, &error);
    }

    double mean(const std::function<double(std::size_t)> &value) const {
        double sum = 0.0;
        for (std::size_t i = 0; i < value_count; ++i)
            sum += value(i);
        return sum / value_count;
    }

    double true_square() const {
        return mean([&](std::size_t i) { return std::pow(denoised[i] - limit_at(i), 2); });
    }

    double true_relative_square() const {
        return mean(
            [&](std::size_t i) { return std::pow(denoised[i] - limit_at(i), 2) / (limit_at(i) * limit_at(i) + 0.01); });
    }

    double raw_square() const {
        return mean([&](std::size_t i) { return std::pow(0.5 * (double{first[i]} + second[i]) - limit_at(i), 2); });
    }

    double raw_relative_square() const {
        return mean([&](std::size_t i) {
            return std::pow(0.5 * (double{first[i]} + second[i]) - limit_at(i), 2) / (limit_at(i) * limit_at(i) + 0.01);
        });
    }

    // Estimates the square of the error. rmse^2 lies 1.28 standard errors above this estimate, and rmse_low^2 lies 1.96
    // below.
    double stated_square() const {
        EXPECT_GT(error.rmse_low, 0.0);
        return (1.96 * std::pow(error.rmse, 2) + 1.28 * std::pow(error.rmse_low, 2)) / (1.96 + 1.28);
    }

    Pixels first;
    Pixels second;
    Pixels guide = Pixels(value_count, 0.5F);
    Pixels denoised = Pixels(value_count, -1.0F);
    pt_error_estimate error{};
    pt_denoise_info info{};
};
