// The filter is fake_open_image_denoise.cpp.
#include "tests/denoise/denoising.h"
#include "tests/support/statistics.h"

#include <algorithm>
#include <limits>
#include <string>

namespace {

// The limits of denoised values depend on both halves, so the stated square is up to a quarter too small. Negative
// estimates of errors count as 0, which makes the square up to a third too large.
TEST(Denoise, StatesTheSquareOfItsError) {
    constexpr int seeds = 24;
    for (const std::string wish : {"identity", "", "shift", "darken"}) {
        std::vector<double> differences;
        double mean_true = 0.0;
        double mean_ratios[2] = {0.0, 0.0};
        for (std::uint64_t seed = 0; seed < seeds; ++seed) {
            Denoising denoising(seed, much_noise);
            ASSERT_EQ(denoising.run(wish), PT_OK) << pt_last_error(nullptr);
            const Squares squares = denoising.true_squares();
            differences.push_back(denoising.stated_square() - squares.absolute);
            mean_true += squares.absolute / seeds;
            mean_ratios[0] += denoising.error.rmse / std::sqrt(squares.absolute) / seeds;
            mean_ratios[1] += denoising.error.relative_rmse / std::sqrt(squares.relative) / seeds;
        }
        const statistics::Moments moments = statistics::moments(differences);
        const double bound = statistics::normal_quantile(1e-6) * std::sqrt(moments.variance / seeds);
        const double chosen = wish == "identity" ? 0.0 : mean_true;
        EXPECT_LT(moments.mean, bound + chosen / 3) << wish;
        EXPECT_GT(moments.mean, -bound - 0.25 * chosen) << wish;
        EXPECT_LT(bound, 0.15 * mean_true) << wish;
        for (const double ratio : mean_ratios) {
            EXPECT_GT(ratio, 0.87) << wish; // sqrt(1 - 1/4)
            EXPECT_LT(ratio, 1.3) << wish;
        }
    }
}

// In each half one of 300 values is brighter by 60. The filter reduces it to 4, which removes 0.2 from the mean. Each
// image has 92,160 / 300^2 = 1 value with such light in both halves.
TEST(Denoise, StatesRareLightThatItsFilterTakesAway) {
    constexpr double probability = 1.0 / 300;
    constexpr double light = 60.0;
    for (std::uint64_t seed = 0; seed < 8; ++seed) {
        Denoising denoising(seed, 0.2);
        denoising.limit = [](std::size_t i) { return limit_at(i) + probability * light; };
        std::mt19937_64 random(seed);
        for (Pixels *const half : {&denoising.first, &denoising.second})
            for (float &value : *half)
                if (uniform(random) < probability)
                    value += static_cast<float>(light);
        ASSERT_EQ(denoising.run("cut"), PT_OK);
        const double ratio = denoising.error.rmse / std::sqrt(denoising.true_squares().absolute);
        EXPECT_GT(ratio, 0.9) << seed;
        EXPECT_LT(ratio, 2.0) << seed;
    }
}

TEST(Denoise, IsNoWorseThanTheRawImage) {
    for (const char *wish : {"identity", "", "shift", "darken"})
        for (const double deviation : {much_noise, 0.2, 0.02})
            for (std::uint64_t seed = 0; seed < 3; ++seed) {
                Denoising denoising(seed, deviation);
                ASSERT_EQ(denoising.run(wish), PT_OK);
                const bool is_good = *wish == '\0' && deviation == much_noise;
                const double most = is_good ? 0.5 : 1.001;
                const auto [absolute, relative] = denoising.true_squares();
                EXPECT_LT(absolute, most * denoising.raw_squares().absolute) << wish << deviation;
                EXPECT_LT(relative, most * denoising.raw_squares().relative) << wish << deviation;
            }
}

struct Level {
    double light;
    double noise;
};

// On stripes of one level, each half has a mark at every fifth place with probability 1/2. At marks blurring is wrong,
// but the limits allow it if only one half has the mark. Elsewhere blurring reduces relative errors where marks are
// bright, and absolute errors where marks are dark.
TEST(Denoise, KeepsMarksThatHalvesHaveByChance) {
    constexpr double mark = 0.8;
    const Level cases[][2] = {{{1, 0.05}, {1, 0.05}}, {{100, 0.005}, {1, 0.5}}, {{0.5, 0.005}, {100, 0.05}}};
    for (const auto &levels : cases) {
        const auto level_at = [&](std::size_t i) { return levels[place_of(i).x / 16 % 2]; };
        const auto mark_at = [&](std::size_t i) {
            const auto [x, y] = place_of(i);
            const bool is_mark = x / 16 % 2 == 0 && x % 5 == 2 && y % 5 == 2;
            return is_mark ? (x % 2 == y % 2 ? mark : -mark) * level_at(i).light : 0.0;
        };
        Denoising denoising{Pixels(value_count), Pixels(value_count)};
        std::mt19937_64 random(1);
        for (std::size_t i = 0; i < value_count; ++i)
            for (Pixels *const half : {&denoising.first, &denoising.second}) {
                const double noise = level_at(i).noise * (2.0 * uniform(random) - 1.0);
                (*half)[i] = static_cast<float>(level_at(i).light * (1.0 + noise));
                (*half)[i] += random() % 2 == 0 ? static_cast<float>(mark_at(i)) : 0.0F;
            }
        denoising.limit = [&](std::size_t i) { return level_at(i).light + 0.5 * mark_at(i); };
        ASSERT_EQ(denoising.run(), PT_OK);
        SCOPED_TRACE(levels[0].light);
        EXPECT_LT(denoising.true_squares().absolute, 1.02 * denoising.raw_squares().absolute);
        EXPECT_LT(denoising.true_squares().relative, 1.02 * denoising.raw_squares().relative);
    }
}

// The ramp rises in the upper half and falls in the lower half, so a filter that shifts it by a pixel keeps the mean.
// The two halves of the samples have opposite noise, so the denoised image shows which fraction of the filter was
// chosen. Over a tile of 8 pixels this fraction must change linearly, without steps.
TEST(Denoise, HasNoSeams) {
    constexpr float slope = 0.02F;
    constexpr std::size_t noisy_width = 100;
    const auto ramp_at = [](std::size_t x, std::size_t y) {
        return 1.0F + slope * static_cast<float>(y < height / 2 ? x : width - 1 - x);
    };
    const auto half = [&](float sign) {
        return pixels_of([&](std::size_t i) {
            const auto [x, y] = place_of(i);
            return ramp_at(x, y) + sign * (x < noisy_width ? 0.3F : 0.01F) * ((x + y) % 2 == 0 ? 1.0F : -1.0F);
        });
    };
    Denoising denoising(half(1.0F), half(-1.0F));
    ASSERT_EQ(denoising.run("shift"), PT_OK);
    const std::size_t y = height / 4;
    const auto share = [&](std::size_t x) { return (denoising.denoised[3 * (y * width + x)] - ramp_at(x, y)) / slope; };
    EXPECT_GT(share(8), 0.9F);
    EXPECT_LT(share(width - 16), 0.5F);
    for (std::size_t x = 9; x < width - 8; ++x) {
        const bool has_other_limits = x + 3 >= noisy_width && x <= noisy_width + 3;
        EXPECT_LT(std::abs(share(x) - share(x - 1)), has_other_limits ? 1.0 : 0.125 + 1e-3) << x;
    }
}

// The noise increases downwards from 0. If s is the standard error of the mean, two standard errors of a half are 2
// sqrt(2) s. A neighbor with more noise may raise s by up to a factor of 16.
TEST(Denoise, MovesNoValueBeyondWhatHalvesSupport) {
    const auto half = [](std::uint64_t seed) {
        return pixels_of([noise = noisy(seed, 1.0)](std::size_t i) {
            const auto [x, y] = place_of(i);
            const bool is_lamp = x >= 64 && x < 68 && y % 40 >= 20 && y % 40 < 24;
            return is_lamp ? 800.0 : std::lerp(limit_at(i), double{noise[i]}, static_cast<double>(y) / height);
        });
    };
    Denoising denoising(half(1), half(2));
    ASSERT_EQ(denoising.run("shift"), PT_OK);
    std::size_t moved = 0;
    for (std::size_t i = 0; i < value_count; ++i) {
        const double mean = denoising.raw_at(i);
        const double spread = std::abs(denoising.first[i] - mean);
        const double move = std::abs(denoising.denoised[i] - mean);
        const double rounding = 1e-6 * mean;
        ASSERT_LE(move, 16.0 * 2.0 * std::sqrt(2.0) * spread + rounding) << i;
        moved += move > rounding ? 1 : 0;
        std::vector<float> around;
        for (std::size_t k = 0; k < 9; ++k) {
            const std::size_t x = std::clamp<std::size_t>(place_of(i).x + k % 3, 1, width) - 1;
            const std::size_t y = std::clamp<std::size_t>(place_of(i).y + k / 3, 1, height) - 1;
            for (const Pixels *values : {&denoising.first, &denoising.second})
                around.push_back((*values)[3 * (y * width + x) + i % 3]);
        }
        const auto [lowest, highest] = std::ranges::minmax(around);
        ASSERT_GE(denoising.denoised[i], lowest - rounding) << i;
        ASSERT_LE(denoising.denoised[i], highest + rounding) << i;
    }
    EXPECT_GT(moved, value_count / 2);
}

TEST(Denoise, KeepsTheMeanWithinItsNoise) {
    for (const char *wish : {"darken", "cut"}) {
        Denoising denoising(3, 0.2);
        for (std::size_t i = 0; i < value_count; i += 300)
            (i % 600 == 0 ? denoising.first : denoising.second)[i] += 60.0F;
        ASSERT_EQ(denoising.run(wish), PT_OK);
        double square = 0.0;
        double shift = 0.0;
        for (std::size_t i = 0; i < value_count; i += 3) {
            square += std::pow(denoising.first[i] - denoising.raw_at(i), 2);
            shift += denoising.denoised[i] - denoising.raw_at(i);
        }
        EXPECT_LE(std::abs(shift), 1.001 * std::sqrt(square)) << wish;
        EXPECT_LT(shift, -0.9 * std::sqrt(square)) << wish;
    }
}

// The image is a checkerboard of mean 1. In one pixel of each tile the halves differ, always by the same amount. The
// filter blurs the checkerboard, so little of the filtered image is used. If one half of such a pixel is dark, a bright
// neighbor may extend into the pixel, so the square counts ln(1 / 0.1) times.
TEST(Denoise, KnowsLittleOfEdgesThatOneHalfDidNotMeet) {
    const auto relative_square = [](double lesser) {
        const auto half = [=](std::size_t parity) {
            return pixels_of([=](std::size_t i) {
                const auto [x, y] = place_of(i);
                const double board = (x + y) % 2 == 0 ? 0.5 : 1.5;
                return x % 8 == 4 && y % 8 == 4 ? lesser + (x / 8 % 2 == parity ? 0.0 : 1.0) : board;
            });
        };
        Denoising denoising(half(0), half(1));
        EXPECT_EQ(denoising.run(), PT_OK);
        return std::pow(denoising.error.relative_rmse, 2);
    };
    EXPECT_NEAR(relative_square(0.0) / relative_square(0.5), std::log(1.0 / 0.1), 0.2);
}

// rmse_high^2 and rmse_low^2 lie 1.96 standard errors from the mean square, and rmse^2 lies 1.28 above it.
TEST(Denoise, BoundsOfFewTilesAreTwiceAsWide) {
    for (const std::size_t tiles : {6, 60}) {
        Denoising denoising(0, 1e-3);
        for (std::size_t tile = 0; tile < tiles; ++tile)
            denoising.first[3 * (tile / 12 * 32 * width + tile % 12 * 16)] += 100.0F;
        ASSERT_EQ(denoising.run("identity"), PT_OK);
        const bool is_uncertain = tiles < 8;
        EXPECT_EQ(denoising.error.uncertain, is_uncertain ? PT_UNCERTAIN_RMSE | PT_UNCERTAIN_RELATIVE_RMSE : 0);
        const double factor = is_uncertain ? 2.0 : 1.0;
        const double low = std::pow(factor * denoising.error.rmse_low, 2);
        const double high = std::pow(denoising.error.rmse_high / factor, 2);
        EXPECT_GT(low, 0.0);
        EXPECT_NEAR(std::pow(denoising.error.rmse, 2), (low + high) / 2 + 1.28 / 1.96 * (high - low) / 2, 1e-9 * high);
    }
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

TEST(Denoise, HandsErrorsOn) {
    Denoising denoising(0, much_noise);
    EXPECT_EQ(denoising.run("1"), PT_ERROR_INTERNAL);
    EXPECT_STREQ(pt_last_error(nullptr), "Open Image Denoise: as planted");
    EXPECT_EQ(denoising.run("4"), PT_ERROR_OUT_OF_HOST_MEMORY);
    EXPECT_EQ(denoising.run("5"), PT_ERROR_UNSUPPORTED);
    EXPECT_EQ(denoising.run(""), PT_OK);
    denoising.info.library = "libm.so.6";
    EXPECT_EQ(denoising.run(), PT_ERROR_UNSUPPORTED);
    EXPECT_NE(std::string(pt_last_error(nullptr)).find("oidnNewDevice"), std::string::npos);
}

TEST(Denoise, RunsTheLibraryItself) {
    Denoising denoising(0, much_noise);
    denoising.info.library = nullptr;
    if (denoising.run() == PT_ERROR_UNSUPPORTED)
        GTEST_SKIP() << pt_last_error(nullptr);
    const double square = denoising.true_squares().absolute;
    EXPECT_LT(square, 0.2 * denoising.raw_squares().absolute);
    EXPECT_GT(denoising.error.rmse / std::sqrt(square), 0.9);
    EXPECT_LT(denoising.error.rmse / std::sqrt(square), 2.0);
    const Pixels once = denoising.denoised;
    ASSERT_EQ(denoising.run(), PT_OK);
    EXPECT_EQ(denoising.denoised, once);
}

} // namespace
