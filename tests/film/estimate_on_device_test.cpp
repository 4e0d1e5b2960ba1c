#include "lib/base/error.h"
#include "lib/code/shader_source.h"
#include "lib/film/error_estimate.h"
#include "lib/film/quotient.h"
#include "lib/film/tile_errors.h"
#include "lib/kernel/device_film.h"
#include "lib/kernel/error_reader.h"
#include "tests/film/film_words.h"
#include "tests/support/expected_error.h"
#include "tests/vulkan/device_fixture.h"

#include <gtest/gtest.h>
#include <pt/pt.h>

#include <algorithm>
#include <cmath>
#include <random>

namespace {

constexpr std::uint32_t part_samples = 32;

class Films {
public:
    // The newer part of the first pixel has `rejected` samples fewer.
    pt::PixelSums film(std::uint32_t width, std::uint32_t height, std::uint32_t rejected = 0) {
        pt::PixelSums sums;
        sums.resize(std::size_t{width} * height);
        for (std::uint32_t i = 0; i < width * height; ++i) {
            const bool lit = (i % width * 3 + i / width * 2) % 61 > 20;
            const bool firefly = uniform_(generator_) < 0.004;
            const bool half_lit = uniform_(generator_) < 0.03;
            const double level = lit ? 0.4 + 0.3 * std::sin(0.05 * (i % width)) : 0.0;
            for (std::uint32_t part = 0; part < pt::gpu::FILM_PARTS; ++part) {
                const double noise = 1.0 + 0.2 * (uniform_(generator_) - 0.5);
                for (std::uint32_t channel = 0; channel < 3; ++channel) {
                    const bool bright = firefly && part == channel % 2;
                    const double share = half_lit ? 1.8 * part : 1.0;
                    const double mean = (level * share * noise + (bright ? 30.0 : 0.0)) / (channel + 1);
                    set_sum(sums, part, channel, i, mean * part_samples);
                }
                sums.plane(part, pt::gpu::FILM_ACCEPTED)[i] = part_samples;
                sums.plane(part, pt::gpu::FILM_REJECTED)[i] = 0;
            }
        }
        sums.plane(pt::newer_part, pt::gpu::FILM_ACCEPTED)[0] -= rejected;
        sums.plane(pt::newer_part, pt::gpu::FILM_REJECTED)[0] += rejected;
        return sums;
    }

private:
    static void set_sum(pt::PixelSums &sums, std::uint32_t part, std::uint32_t channel, std::size_t pixel, double sum) {
        const auto fixed = static_cast<pt::WideSum>(std::ldexp(sum, pt::gpu::FILM_FRACTION_BITS));
        for (std::uint32_t word = 0; word < pt::gpu::FILM_SUM_WORDS; ++word)
            sums.plane(part, channel * pt::gpu::FILM_SUM_WORDS + word)[pixel] =
                static_cast<std::uint32_t>(fixed >> (32 * word));
    }

    std::mt19937_64 generator_{2026};
    std::uniform_real_distribution<double> uniform_{0.0, 1.0};
};

struct Size {
    std::uint32_t width, height;
};

class EstimateTest : public VulkanFixture {
protected:
    void SetUp() override {
        VulkanFixture::SetUp();
        device_with(pt::vulkan::gpu_like_policy());
    }

    static constexpr pt::SampleConditions conditions{PT_SAMPLER_SOBOL, false};

    static pt::TileSamples samples_of(const Size &size) {
        return pt::TileSamples({size.width, size.height}, pt::SampleSet({0, 2 * part_samples}));
    }

    static pt::FilmErrors::ReadRows reader_of(const pt::PixelSums &sums, const Size &size) {
        return [&sums, size](std::uint32_t first_row, pt::PixelSums &rows) {
            rows.copy(sums, std::size_t{first_row} * size.width, rows.pixel_count(), 0);
        };
    }

    static pt::ErrorEstimate on_host(const pt::PixelSums &sums, const Size &size, double unit) {
        pt::ErrorEstimator estimator(conditions);
        pt::FilmErrors errors;
        for (const pt::TileErrors &tile : errors.of(samples_of(size), unit, reader_of(sums, size)))
            estimator.add(tile);
        return estimator.result();
    }

    struct Found {
        pt::ErrorEstimate estimate;
        std::uint64_t rejected;
    };

    Found on_device(const pt::PixelSums &sums, const Size &size, double unit, std::uint32_t max_strip_pixels,
                    std::span<double> squares_of_tiles = {}) {
        const pt::vulkan::ComputePipeline pipeline = pt::estimate_pipeline(device(), pt::embedded_code().estimate);
        pt::DeviceFilm film(device(), size.width, size.height, max_strip_pixels);
        EXPECT_TRUE(film.has_whole_tiles());
        fill(device(), film, sums);
        pt::ErrorEstimator estimator(conditions);
        const pt::TileSamples samples = samples_of(size);
        pt::ErrorReader(device(), pipeline, film).read({unit, samples, squares_of_tiles}, [&](const auto &tiles) {
            estimator.add(tiles);
        });
        return {estimator.result(), estimator.rejected()};
    }

    static void expect_close(const pt::Interval &found, const pt::Interval &expected, const std::string &which) {
        const auto expect = [&](double value, double exact) {
            EXPECT_LE(std::abs(value - exact), 4e-6 * exact) << which << ": " << value << ", not " << exact;
        };
        expect(found.estimate, expected.estimate);
        expect(found.low, expected.low);
        expect(found.high, expected.high);
    }

    Films films_;
};

// In some units of radiance, squares or their sums exceed the range of float.
TEST_F(EstimateTest, IsThatOfTheHost) {
    double largest = 0.0;
    for (const Size &size : {Size{1, 1}, Size{7, 3}, Size{33, 32}, Size{200, 111}, Size{64, 300}})
        for (const double unit : {1.0, 0x1p-120, 0x1p-60, 0x1p30, 0x1p52}) {
            const pt::PixelSums sums = films_.film(size.width, size.height);
            const pt::ErrorEstimate expected = on_host(sums, size, unit);
            std::vector<double> squares(samples_of(size).grid().count());
            const pt::ErrorEstimate found = on_device(sums, size, unit, size.width * 70, squares).estimate;
            const std::string which =
                std::to_string(size.width) + " x " + std::to_string(size.height) + " in " + std::to_string(unit);
            expect_close(found.rmse, expected.rmse, which);
            expect_close(found.relative_rmse, expected.relative_rmse, which + ", relative");
            EXPECT_EQ(found.uncertain, expected.uncertain) << which;
            pt::FilmErrors host;
            const std::span<const pt::TileErrors> tiles = host.of(samples_of(size), unit, reader_of(sums, size));
            for (std::size_t tile = 0; tile < squares.size(); ++tile)
                EXPECT_NEAR(squares[tile], tiles[tile].own_square(), 1e-5 * tiles[tile].own_square()) << which;
            largest = std::max(largest, *std::ranges::max_element(squares));
        }
    EXPECT_GT(largest, 0.0);
}

TEST_F(EstimateTest, CountsWhatWasLeftOut) {
    const Size size{40, 40};
    EXPECT_EQ(on_device(films_.film(40, 40, 5), size, 1.0, 1U << 20).rejected, 5U);
    const Found found = on_device(films_.film(40, 40, part_samples), size, 1.0, 1U << 20);
    EXPECT_EQ(found.rejected, part_samples);
    EXPECT_TRUE(std::isinf(found.estimate.rmse.estimate)) << "a pixel without samples in a part tells nothing";
}

TEST_F(EstimateTest, LostSamplesAreAnError) {
    pt::PixelSums sums = films_.film(40, 40);
    sums.plane(pt::newer_part, pt::gpu::FILM_ACCEPTED)[1599] -= 1;
    const pt::Error error = error_of([&] { on_device(sums, {40, 40}, 1.0, 1U << 20); });
    EXPECT_EQ(error.code(), PT_ERROR_INTERNAL);
    EXPECT_STREQ(error.what(), "the driver lost samples of 1 pixels");
}

TEST_F(EstimateTest, SamplesThatATileLostAreAnError) {
    Films films;
    const pt::PixelSums sums = films.film(40, 40);
    pt::TileSamples samples({40, 40}, pt::SampleSet({0, 2 * part_samples}));
    samples.set(7, pt::SampleSet({0, 2 * part_samples + 1}));
    const pt::vulkan::ComputePipeline pipeline = pt::estimate_pipeline(device(), pt::embedded_code().estimate);
    pt::DeviceFilm film(device(), 40, 40, 1600);
    fill(device(), film, sums);
    std::vector<double> squares(samples.grid().count());
    pt::ErrorReader reader(device(), pipeline, film);
    EXPECT_THROW(reader.read({1.0, samples, squares}, [](const auto &) {}), pt::Error);
    samples.set(7, pt::SampleSet({0, 2 * part_samples}));
    EXPECT_NO_THROW(reader.read({1.0, samples, squares}, [](const auto &) {}));
}

TEST_F(EstimateTest, SamplesThatAPixelLostAreAnErrorOnTheHost) {
    Films films;
    pt::PixelSums sums = films.film(45, 21);
    pt::DeviceFilm film(device(), 45, 21, 45 * 21);
    pt::DeviceFilm *const all[] = {&film};
    const pt::TileSamples even({45, 21}, pt::SampleSet({0, 2 * part_samples}));
    pt::TileSamples uneven = even;
    uneven.set(4, pt::SampleSet({0, part_samples + part_samples / 2}));
    constexpr std::uint32_t first = 50;
    pt::PixelSums read;
    read.resize(45 * 21 - first);
    for (const pt::TileSamples &samples : {even, uneven}) {
        for (std::uint32_t y = 0; y < 8; ++y)
            for (std::uint32_t x = 32; x < 40; ++x)
                sums.plane(pt::newer_part, pt::gpu::FILM_ACCEPTED)[y * 45 + x] =
                    samples.even() ? part_samples : part_samples / 2;
        fill(device(), film, sums);
        EXPECT_NO_THROW(pt::read_films(all, samples, first, read));
        for (const std::size_t pixel : {50, 71, 77, 80, 84, 85, 100, 944})
            for (const std::uint32_t part : {pt::older_part, pt::newer_part})
                for (const int change : {1, -1}) {
                    pt::PixelSums damaged = sums;
                    damaged.plane(part, pt::gpu::FILM_ACCEPTED)[pixel] += static_cast<std::uint32_t>(change);
                    fill(device(), film, damaged);
                    EXPECT_THROW(pt::read_films(all, samples, first, read), pt::Error) << pixel;
                }
    }
}

} // namespace
