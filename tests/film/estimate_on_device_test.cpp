#include "lib/base/error.h"
#include "lib/code/shader_source.h"
#include "lib/film/error_estimate.h"
#include "lib/film/tile_errors.h"
#include "lib/kernel/device_film.h"
#include "lib/kernel/error_reader.h"
#include "tests/film/film_words.h"
#include "tests/film/random_sums.h"
#include "tests/support/expected_error.h"
#include "tests/vulkan/device_fixture.h"

#include <gtest/gtest.h>
#include <pt/pt.h>

#include <algorithm>
#include <cmath>
#include <random>
#include <string>
#include <vector>

namespace {

constexpr std::uint32_t part_samples = 32;

class Films {
public:
    // The newer part of the first pixel has `rejected` samples fewer.
    pt::PixelSums film(std::uint32_t width, std::uint32_t height, std::uint32_t rejected = 0) {
        std::vector<ResolvedPixel> pixels(std::size_t{width} * height);
        for (std::uint32_t i = 0; i < width * height; ++i) {
            const bool lit = (i % width * 3 + i / width * 2) % 61 > 20;
            const bool firefly = uniform_(generator_) < 0.004;
            const bool half_lit = uniform_(generator_) < 0.03;
            const double level = lit ? 0.4 + 0.3 * std::sin(0.05 * (i % width)) : 0.0;
            for (std::uint32_t part = 0; part < pt::gpu::FILM_PARTS; ++part) {
                const double noise = 1.0 + 0.2 * (uniform_(generator_) - 0.5);
                pixels[i].parts[part] = {{}, part_samples, part_samples};
                for (std::uint32_t channel = 0; channel < 3; ++channel) {
                    const bool bright = firefly && part == channel % 2;
                    const double share = half_lit ? 1.8 * part : 1.0;
                    const double mean = (level * share * noise + (bright ? 30.0 : 0.0)) / (channel + 1);
                    pixels[i].parts[part].sums[channel] =
                        static_cast<pt::WideSum>(std::ldexp(mean * part_samples, pt::gpu::FILM_FRACTION_BITS));
                }
            }
        }
        pixels[0].parts[pt::newer_part].accepted -= rejected;
        return film_of(pixels);
    }

private:
    std::mt19937_64 generator_{2026};
    std::uniform_real_distribution<double> uniform_{0.0, 1.0};
};

class EstimateTest : public VulkanFixture {
protected:
    void SetUp() override {
        VulkanFixture::SetUp();
        device_with(pt::vulkan::gpu_like_policy());
    }

    static constexpr pt::SampleConditions conditions{PT_SAMPLER_SOBOL, false};

    static pt::TileSamples samples_of(const pt::TileGrid &grid) {
        return pt::TileSamples(grid, pt::SampleSet({0, 2 * part_samples}));
    }

    struct Found {
        pt::ErrorEstimate estimate;
        std::uint64_t rejected;
    };

    Found on_device(const pt::PixelSums &sums, const pt::TileSamples &samples, double unit = 1.0,
                    std::uint32_t max_strip_pixels = 1U << 20, std::span<double> squares_of_tiles = {}) {
        const pt::vulkan::ComputePipeline pipeline = pt::estimate_pipeline(device(), pt::embedded_code().estimate);
        pt::DeviceFilm film(device(), samples.grid().width, samples.grid().height, max_strip_pixels);
        EXPECT_TRUE(film.has_whole_tiles());
        fill(device(), film, sums);
        pt::ErrorEstimator estimator(conditions);
        pt::ErrorReader(device(), pipeline, film).read({unit, samples, squares_of_tiles}, [&](const auto &tiles) {
            estimator.add(tiles);
        });
        return {estimator.result(), estimator.rejected()};
    }

    static void expect_close(const pt::Interval &found, const pt::Interval &expected) {
        EXPECT_NEAR(found.estimate, expected.estimate, 4e-6 * expected.estimate);
        EXPECT_NEAR(found.low, expected.low, 4e-6 * expected.low);
        EXPECT_NEAR(found.high, expected.high, 4e-6 * expected.high);
    }

    Films films_;
};

// In some units of radiance, squares or their sums exceed the range of float.
TEST_F(EstimateTest, IsThatOfTheHost) {
    double largest = 0.0;
    for (const pt::TileGrid &grid : {pt::TileGrid{1, 1}, {7, 3}, {33, 32}, {200, 111}, {64, 300}})
        for (const double unit : {1.0, 0x1p-120, 0x1p-60, 0x1p30, 0x1p52}) {
            SCOPED_TRACE(std::to_string(grid.width) + " columns in " + std::to_string(unit));
            const pt::PixelSums sums = films_.film(grid.width, grid.height);
            const pt::TileSamples samples = samples_of(grid);
            pt::FilmErrors errors;
            const auto tiles = errors.of(samples, unit, [&](std::uint32_t first_row, pt::PixelSums &rows) {
                rows.copy(sums, std::size_t{first_row} * grid.width, rows.pixel_count(), 0);
            });
            pt::ErrorEstimator host(conditions);
            for (const pt::TileErrors &tile : tiles)
                host.add(tile);
            std::vector<double> squares(grid.count());
            const pt::ErrorEstimate found = on_device(sums, samples, unit, grid.width * 70, squares).estimate;
            expect_close(found.rmse, host.result().rmse);
            expect_close(found.relative_rmse, host.result().relative_rmse);
            EXPECT_EQ(found.uncertain, host.result().uncertain);
            for (std::size_t tile = 0; tile < squares.size(); ++tile)
                EXPECT_NEAR(squares[tile], tiles[tile].own_square(), 1e-5 * tiles[tile].own_square());
            largest = std::max(largest, *std::ranges::max_element(squares));
        }
    EXPECT_GT(largest, 0.0);
}

TEST_F(EstimateTest, CountsWhatWasLeftOut) {
    const pt::TileSamples samples = samples_of({40, 40});
    EXPECT_EQ(on_device(films_.film(40, 40, 5), samples).rejected, 5U);
    const Found found = on_device(films_.film(40, 40, part_samples), samples);
    EXPECT_EQ(found.rejected, part_samples);
    EXPECT_TRUE(std::isinf(found.estimate.rmse.estimate)) << "a pixel without samples in a part tells nothing";
}

TEST_F(EstimateTest, LostSamplesAreAnError) {
    pt::PixelSums sums = films_.film(40, 40);
    pt::TileSamples samples = samples_of({40, 40});
    samples.set(7, pt::SampleSet({0, 2 * part_samples + 1}));
    EXPECT_THROW(on_device(sums, samples), pt::Error) << "all pixels of a tile";
    sums.plane(pt::newer_part, pt::gpu::FILM_ACCEPTED)[1599] -= 1;
    const pt::Error error = error_of([&] { on_device(sums, samples_of({40, 40})); });
    EXPECT_EQ(error.code(), PT_ERROR_INTERNAL);
    EXPECT_STREQ(error.what(), "the driver lost samples of 1 pixels");
}

TEST_F(EstimateTest, SamplesThatAPixelLostAreAnErrorOnTheHost) {
    pt::PixelSums sums = films_.film(45, 21);
    pt::DeviceFilm film(device(), 45, 21, 45 * 21);
    pt::DeviceFilm *const all[] = {&film};
    const pt::TileSamples even = samples_of({45, 21});
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
