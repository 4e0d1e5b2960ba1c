// Two noisy halves of a picture with known limits, denoised by the library that CMake names.
#pragma once

#include "tests/support/sized.h"

#include <pt/denoise.h>
#include <pt/pt.h>

#include <gtest/gtest.h>

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <functional>
#include <random>
#include <string>
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

struct Place {
    std::size_t x, y;
};

inline Place place_of(std::size_t index) {
    return {index / 3 % width, index / 3 / width};
}

inline Pixels pixels_of(const auto &value) {
    Pixels pixels(value_count);
    for (std::size_t i = 0; i < value_count; ++i)
        pixels[i] = static_cast<float>(value(i));
    return pixels;
}

// In [0, 1).
inline double uniform(std::mt19937_64 &random) {
    return static_cast<double>(random() >> 11) * 0x1p-53;
}

// `deviation` is relative to the mean.
inline Pixels noisy(std::uint64_t seed, double deviation) {
    std::mt19937_64 random(seed);
    return pixels_of(
        [&](std::size_t i) { return limit_at(i) * (1.0 + deviation * (-std::log(uniform(random) + 0x1p-54) - 1.0)); });
}

using Values = std::function<double(std::size_t)>;

// Mean squares of errors, and of relative errors.
struct Squares {
    double absolute;
    double relative;
};

struct Denoising {
    explicit Denoising(Pixels first_half, Pixels second_half) :
        first(std::move(first_half)),
        second(std::move(second_half)) {
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

    pt_result run(const std::string &wish = "") {
        setenv("FAKE_OIDN", wish.c_str(), 1);
        return pt_denoise(&info, &error);
    }

    double raw_at(std::size_t i) const { return 0.5 * (double{first[i]} + second[i]); }

    Squares raw_squares() const {
        return squares([&](std::size_t i) { return raw_at(i); });
    }

    Squares true_squares() const {
        return squares([&](std::size_t i) { return denoised[i]; });
    }

    // Estimates the square of the error. rmse^2 lies 1.28 standard errors above this estimate, and rmse_low^2 lies 1.96
    // below.
    double stated_square() const {
        EXPECT_GT(error.rmse_low, 0.0);
        return (1.96 * std::pow(error.rmse, 2) + 1.28 * std::pow(error.rmse_low, 2)) / (1.96 + 1.28);
    }

    Values limit = &limit_at;
    Pixels first;
    Pixels second;
    Pixels guide = Pixels(value_count, 0.5F);
    Pixels denoised = Pixels(value_count, -1.0F);
    pt_error_estimate error = sized<pt_error_estimate>();
    pt_denoise_info info = sized<pt_denoise_info>();

private:
    Squares squares(const Values &value) const {
        Squares means{};
        for (std::size_t i = 0; i < value_count; ++i) {
            const double square = std::pow(value(i) - limit(i), 2) / value_count;
            means.absolute += square;
            means.relative += square / (limit(i) * limit(i) + 0.01);
        }
        return means;
    }
};
