// Denoising with a library that stands in for Open Image Denoise (fake_open_image_denoise.cpp): the error that is
// stated against the true one, in double precision, of pictures whose limit is known.
#include "tests/support/statistics.h"

#include <pt/denoise.h>
#include <pt/pt.h>

#include <gtest/gtest.h>

#include <cmath>
#include <cstdlib>
#include <functional>
#include <limits>
#include <random>
#include <string>
#include <vector>

namespace {

using Pixels = std::vector<float>;

constexpr std::uint32_t width = 192;
constexpr std::uint32_t height = 160;
constexpr double much_noise = 0.7;
constexpr std::size_t value_count = std::size_t{3} * width * height;

// Stripes, whose edges a filter blurs, all over the picture.
double limit_at(std::size_t index) {
    return 0.6 + 0.4 * static_cast<double>(index / 3 % width / 12 % 2) + 0.1 * static_cast<double>(index % 3);
}

// An exponential distribution, skewed as light is, whose deviation is this part of the mean.
Pixels noisy(std::uint64_t seed, double deviation) {
    std::mt19937_64 random(seed);
    Pixels pixels(value_count);
    for (std::size_t i = 0; i < value_count; ++i) {
        const double uniform = (static_cast<double>(random() >> 11) + 0.5) * 0x1p-53;
        pixels[i] = static_cast<float>(limit_at(i) * (1.0 + deviation * (-std::log(uniform) - 1.0)));
    }
    return pixels;
}

// Images to denoise, and what comes of it.
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

    // Over all values.
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

    // Of rmse, which is 1.28 standard errors of squares above it, and its lower bound, 1.96 below.
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

struct Stated {
    std::vector<double> differences; // stated squares less true ones
    double mean_true = 0.0;
    double mean_raw = 0.0;
    double mean_ratio = 0.0;          // of stated roots to true ones
    double mean_relative_ratio = 0.0; // likewise
};

Stated over_seeds(const char *wish, double deviation, int seed_count = 6) {
    Stated stated;
    for (int seed = 0; seed < seed_count; ++seed) {
        Denoising denoising(static_cast<std::uint64_t>(seed), deviation);
        EXPECT_EQ(denoising.run(wish), PT_OK) << pt_last_error(nullptr);
        stated.differences.push_back(denoising.stated_square() - denoising.true_square());
        stated.mean_true += denoising.true_square() / seed_count;
        stated.mean_raw += denoising.raw_square() / seed_count;
        stated.mean_ratio += denoising.error.rmse / std::sqrt(denoising.true_square()) / seed_count;
        stated.mean_relative_ratio +=
            denoising.error.relative_rmse / std::sqrt(denoising.true_relative_square()) / seed_count;
    }
    return stated;
}

// Where nothing is chosen, as with a filter that does nothing, there is no bias at all. Else the choice makes the
// square too small by less than a twentieth, and places whose faults count for 0 at least make it too large by less
// than a third. Faults of the filter are in it, to which the difference of the filtered halves is blind.
TEST(Denoise, StatesTheSquareOfItsErrorWithoutBias) {
    double without_fault = 0.0;
    for (const char *wish : {"identity", "", "shift", "darken"}) {
        const Stated stated = over_seeds(wish, much_noise, 24);
        const statistics::Moments moments = statistics::moments(stated.differences);
        const double bound = statistics::normal_quantile(1e-6) *
                             std::sqrt(moments.variance / static_cast<double>(stated.differences.size()));
        const double chosen = std::string(wish) == "identity" ? 0.0 : stated.mean_true;
        EXPECT_LT(moments.mean, bound + chosen / 3) << wish;
        EXPECT_GT(moments.mean, -bound - 0.05 * chosen) << wish;
        EXPECT_LT(bound, 0.15 * stated.mean_true) << wish; // or it would say nothing
        for (const double ratio : {stated.mean_ratio, stated.mean_relative_ratio}) {
            EXPECT_GT(ratio, 0.9) << wish;
            EXPECT_LT(ratio, 1.3) << wish;
        }
        EXPECT_GT(stated.mean_true, 1.1 * without_fault) << wish; // there is something to be seen
        without_fault = *wish == '\0' ? stated.mean_true : without_fault;
    }
}

// One value in 300 of a half is brighter by 60, which the filter cuts to 4: it loses 0.2 everywhere. Both halves meet
// such light in one value of a picture in 92,160 / 300^2, so products of single values show the loss in every second
// picture, as far too much. Each picture has to state it.
TEST(Denoise, StatesRareLightThatItsFilterTakesAway) {
    constexpr double probability = 1.0 / 300;
    constexpr double light = 60.0;
    for (std::uint64_t seed = 0; seed < 8; ++seed) {
        Denoising denoising(seed, 0.2);
        std::mt19937_64 random(seed);
        for (Pixels *const half : {&denoising.first, &denoising.second})
            for (float &value : *half)
                if (static_cast<double>(random() >> 11) * 0x1p-53 < probability)
                    value += static_cast<float>(light);
        ASSERT_EQ(denoising.run("cut"), PT_OK);
        const double true_square = denoising.mean(
            [&](std::size_t i) { return std::pow(denoising.denoised[i] - limit_at(i) - probability * light, 2); });
        EXPECT_GT(denoising.error.rmse / std::sqrt(true_square), 0.9) << seed;
        EXPECT_LT(denoising.error.rmse / std::sqrt(true_square), 2.0) << seed;
    }
}

// Neither with much noise nor with little, when a filter that shifts or darkens does more harm than good.
TEST(Denoise, IsNoWorseThanTheRawImage) {
    for (const char *wish : {"identity", "", "shift", "darken"})
        for (const double deviation : {much_noise, 0.2, 0.02}) {
            const Stated stated = over_seeds(wish, deviation);
            const bool is_good = *wish == '\0' && deviation == much_noise;
            EXPECT_LT(stated.mean_true, (is_good ? 0.5 : 1.001) * stated.mean_raw) << wish << deviation;
        }
}

// Noise in the left half alone, of opposite signs in the two images, so that their mean is 1 and what is left of the
// darkening shows the choice: most of it at the left, none at the right, and between them no step. A linear ramp over a
// tile of 8 pixels that goes all the way has steps of an 8th.
TEST(Denoise, HasNoSeams) {
    Pixels halves[2] = {Pixels(value_count, 1.0F), Pixels(value_count, 1.0F)};
    for (std::size_t i = 0; i < value_count; ++i)
        if (i / 3 % width < width / 2) {
            halves[0][i] = 1.3F;
            halves[1][i] = 0.7F;
        }
    Denoising denoising(halves[0], halves[1]);
    ASSERT_EQ(denoising.run("darken"), PT_OK);
    const std::size_t row = std::size_t{3} * width * (height / 2);
    EXPECT_LT(denoising.denoised[row], 0.951F);
    EXPECT_EQ(denoising.denoised[row + 3 * (width - 1)], 1.0F);
    for (std::size_t x = 1; x < width; ++x)
        EXPECT_LT(std::abs(denoising.denoised[row + 3 * x] - denoising.denoised[row + 3 * (x - 1)]), 0.05 / 8 + 1e-6)
            << x;
}

// The filter spreads a lamp over two pixels to each side, where relative errors would be a million times those of the
// raw image. By what it gives there as limits they would seem small.
TEST(Denoise, DoesNotSpreadALamp) {
    constexpr std::size_t first = 64;
    constexpr std::size_t end = 68;
    const auto is_lamp = [](std::size_t x, std::size_t y) { return x >= first && x < end && y >= first && y < end; };
    const auto for_each = [&](bool lamp, const std::function<void(std::size_t)> &use) {
        for (std::size_t i = 0; i < value_count; ++i)
            if (is_lamp(i / 3 % width, i / 3 / width) == lamp)
                use(i);
    };
    Denoising denoising(0, 0.02);
    for_each(true, [&](std::size_t i) { denoising.first[i] *= 1e6F, denoising.second[i] *= 1e6F; });
    ASSERT_EQ(denoising.run(), PT_OK);
    for_each(false, [&](std::size_t i) { EXPECT_NEAR(denoising.denoised[i], limit_at(i), 0.3); });
    EXPECT_LT(denoising.error.relative_rmse, 0.02);
}

// A pixel in each tile differs by as much in both halves, of a checkerboard of the mean 1 that the filter blurs, so
// that little of it is used. Where one half is dark, what most samples met may reach into the pixel by any share, and
// the square counts ln(1 / 0.1) times.
TEST(Denoise, KnowsLittleOfEdgesThatOneHalfDidNotMeet) {
    const auto relative_square = [](float lesser) {
        Pixels halves[2] = {Pixels(value_count), Pixels(value_count)};
        for (std::size_t i = 0; i < value_count; ++i) {
            const std::size_t x = i / 3 % width;
            const std::size_t y = i / 3 / width;
            halves[0][i] = halves[1][i] = (x + y) % 2 == 0 ? 0.5F : 1.5F;
            if (x % 8 == 4 && y % 8 == 4) {
                halves[x / 8 % 2][i] = lesser;
                halves[1 - x / 8 % 2][i] = lesser + 1.0F;
            }
        }
        Denoising denoising(halves[0], halves[1]);
        EXPECT_EQ(denoising.run(), PT_OK);
        return std::pow(denoising.error.relative_rmse, 2);
    };
    EXPECT_NEAR(relative_square(0.0F) / relative_square(0.5F), std::log(1.0 / 0.1), 0.2);
}

TEST(Denoise, IsUncertainOfFewTiles) {
    Denoising even(0, much_noise);
    ASSERT_EQ(even.run(), PT_OK);
    EXPECT_EQ(even.error.uncertain, 0U);
    Denoising uneven(0, much_noise);
    uneven.first[0] = 1e5F;
    ASSERT_EQ(uneven.run(), PT_OK);
    EXPECT_EQ(uneven.error.uncertain, std::uint32_t{PT_UNCERTAIN_RMSE} | PT_UNCERTAIN_RELATIVE_RMSE);
}

TEST(Denoise, RefusesWhatBreaksARule) {
    const auto refused = [](const std::function<void(Denoising &)> &change, const std::string &message) {
        Denoising denoising(0, much_noise);
        change(denoising);
        EXPECT_EQ(denoising.run(), PT_ERROR_INVALID_ARGUMENT) << message;
        EXPECT_EQ(pt_last_error(nullptr), message);
        EXPECT_EQ(denoising.error.rmse, 0.0);
        EXPECT_EQ(denoising.denoised[0], -1.0F);
    };
    refused([](Denoising &d) { d.info.width = 0; }, "denoise.width * height = 0: must be in [1, 2^32 - 1]");
    refused([](Denoising &d) { d.info.width = d.info.height = 65536; },
            "denoise.width * height = 4294967296: must be in [1, 2^32 - 1]");
    refused([](Denoising &d) { d.info.normal = nullptr; }, "denoise.normal = NULL: must not be NULL");
    refused([](Denoising &d) { d.info.denoised = nullptr; }, "denoise.denoised = NULL: must not be NULL");
    refused([](Denoising &d) { d.second[7] = std::numeric_limits<float>::infinity(); },
            "denoise.second[7] = inf: must be finite");
    refused([](Denoising &d) { d.error.struct_size = 0; },
            "error.struct_size = 0: must be the size of the struct, which holds this field");
    EXPECT_EQ(pt_denoise(nullptr, nullptr), PT_ERROR_INVALID_ARGUMENT);
}

TEST(Denoise, SaysWhatItLacks) {
    Denoising denoising(0, much_noise);
    denoising.info.library = "no-such-library.so";
    EXPECT_EQ(denoising.run(), PT_ERROR_UNSUPPORTED);
    const std::string message = pt_last_error(nullptr);
    EXPECT_EQ(message.find("denoise.library = \"no-such-library.so\": Open Image Denoise 2 cannot be loaded: "), 0U);
    EXPECT_NE(message.find("pip install pyoidn"), std::string::npos);
    denoising.info.library = "libm.so.6"; // which has none of the functions
    EXPECT_EQ(denoising.run(), PT_ERROR_UNSUPPORTED);
    EXPECT_NE(std::string(pt_last_error(nullptr)).find("oidnNewDevice"), std::string::npos);
}

TEST(Denoise, HandsErrorsOn) {
    Denoising denoising(0, much_noise);
    EXPECT_EQ(denoising.run("1"), PT_ERROR_INTERNAL);
    EXPECT_STREQ(pt_last_error(nullptr), "Open Image Denoise: as planted");
    EXPECT_EQ(denoising.run("4"), PT_ERROR_OUT_OF_HOST_MEMORY);
    EXPECT_EQ(denoising.run("5"), PT_ERROR_UNSUPPORTED);
    EXPECT_EQ(denoising.run(""), PT_OK);
}

TEST(Denoise, RunsOnTheCpuUnlessTold) {
    Denoising denoising(0, much_noise);
    EXPECT_EQ(denoising.run("gpu"), PT_ERROR_UNSUPPORTED);
    denoising.info.any_device = 1;
    EXPECT_EQ(denoising.run("gpu"), PT_OK);
}

// Where the system finds it, as LD_LIBRARY_PATH may say.
TEST(Denoise, RunsTheLibraryItself) {
    Denoising denoising(0, much_noise);
    denoising.info.library = nullptr;
    if (denoising.run() == PT_ERROR_UNSUPPORTED)
        GTEST_SKIP() << pt_last_error(nullptr);
    EXPECT_LT(denoising.true_square(), 0.2 * denoising.raw_square());
    EXPECT_GT(denoising.error.rmse / std::sqrt(denoising.true_square()), 0.9);
    EXPECT_LT(denoising.error.rmse / std::sqrt(denoising.true_square()), 2.0);
    const Pixels once = denoising.denoised;
    ASSERT_EQ(denoising.run(), PT_OK);
    EXPECT_EQ(denoising.denoised, once);
}

} // namespace
