// Every estimator with every sampler has the same mean; uneven and many lamps against closed forms; Russian roulette
// against the exact light of an enclosure. Run alone with --gtest_filter=Estimator*.
#include "tests/device/floor_radiance.h"
#include "tests/support/batch_fixture.h"
#include "tests/support/coursework_scene.h"
#include "tests/support/scene_of.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <numeric>
#include <vector>

namespace {

// One false alarm in a million for the file: each comparison has its share of that.
constexpr double false_alarms = 1e-6;
constexpr double comparisons = 1000;
double allowed(std::size_t batch_count) {
    return student_bound(false_alarms / comparisons, batch_count);
}

// A scene from lists, which it keeps.
struct ListedScene {
    std::vector<pt_material> materials;
    std::vector<pt_sphere> spheres;
    std::vector<pt_plane> planes;

    pt_scene scene() const { return scene_of(materials, spheres, planes); }
};

pt_material diffuse(float albedo) {
    return {{albedo, albedo, albedo}, {0, 0, 0}, {0, 0, 0}, 0, 0};
}

pt_material lamp(float radiance) {
    return {{0, 0, 0}, {0, 0, 0}, {radiance, radiance, radiance}, 0, 0};
}

constexpr pt_plane floor_plane{{0, 1, 0}, 1, 0, 0};

// The floor of floor_radiance() under lamps.
ListedScene floor_under(const std::vector<FloorLamp> &lamps) {
    ListedScene listed{{diffuse(0.8F)}, {}, {floor_plane}};
    for (const FloorLamp &source : lamps) {
        listed.spheres.push_back({{source.centre.x, source.centre.y, source.centre.z},
                                  source.radius,
                                  {0, 0, 0},
                                  static_cast<uint32_t>(listed.materials.size()),
                                  0});
        listed.materials.push_back(lamp(static_cast<float>(source.radiance)));
    }
    return listed;
}

class Estimator : public BatchFixture {};

// ---- All estimators, all samplers --------------------------------------------------------------------------------

// A lamp so large that directions find it by chance, over a floor with a diffuse and a glossy ball: finite variance
// for all.
ListedScene large_lamp() {
    const pt_material glossy{{0.3F, 0.3F, 0.3F}, {0.5F, 0.5F, 0.5F}, {0, 0, 0}, 10, 0};
    return {{diffuse(0.8F), lamp(5), diffuse(0.6F), glossy},
            {{{0.5, 4, -6}, 2, {0, 0, 0}, 1, 0},
             {{-1.2, -0.2, -5}, 0.8, {0, 0, 0}, 2, 0},
             {{1.2, -0.2, -4.5}, 0.8, {0, 0, 0}, 3, 0}},
            {floor_plane}};
}

constexpr uint32_t mean_batches = 32;
constexpr uint32_t mean_samples = 48;

struct Means {
    Estimate whole;       // image
    Estimate glossy_part; // its right half below the horizon, where the glossy ball is
};

Means means_of(const Batches &batches) {
    std::vector<std::size_t> all(batches[0].size());
    std::iota(all.begin(), all.end(), std::size_t{0});
    std::vector<std::size_t> part;
    for (std::size_t row = 4; row < 7; ++row)
        for (std::size_t column = 9; column < 12; ++column)
            part.push_back(16 * row + column);
    return {estimate_over(batches, all), estimate_over(batches, part)};
}

// Standard errors between two independent estimates.
double difference(const Estimate &a, const Estimate &b) {
    return (a.mean - b.mean) / std::hypot(a.standard_error, b.standard_error);
}

class EstimatorMeans : public BatchFixture, public testing::WithParamInterface<uint32_t> {};

TEST_P(EstimatorMeans, AgreeForAllEstimatorsAndSamplers) {
    const ListedScene listed = large_lamp();
    set_up(listed.scene(), CourseworkScene::camera());
    pt_render render = render_of(16, 8, GetParam());
    render.seed = 1000;
    const Means reference = means_of(render_batches(render, mean_batches, 8 * mean_samples));
    const double bound = allowed(mean_batches);
    double worst_error = 0.0;
    // A sampler gives the same numbers to every estimator, so beyond two vertices one is enough for each.
    for (const uint32_t estimator :
         {PT_ESTIMATOR_UNIFORM, PT_ESTIMATOR_COSINE, PT_ESTIMATOR_BSDF, PT_ESTIMATOR_LIGHT, PT_ESTIMATOR_MIS})
        for (const uint32_t sampler : {PT_SAMPLER_RANDOM, PT_SAMPLER_HALTON, PT_SAMPLER_HALTON_CP, PT_SAMPLER_SOBOL}) {
            if (GetParam() > 2 && sampler != 1 + estimator % 4)
                continue;
            render.estimator = estimator;
            render.sampler = sampler;
            render.seed = 100 * estimator;
            const Means means = means_of(render_batches(render, mean_batches, mean_samples));
            EXPECT_LT(std::abs(difference(means.whole, reference.whole)), bound)
                << "estimator " << estimator << " sampler " << sampler << ": " << means.whole.mean << " +- "
                << means.whole.standard_error << " against " << reference.whole.mean << " +- "
                << reference.whole.standard_error;
            EXPECT_LT(std::abs(difference(means.glossy_part, reference.glossy_part)), bound)
                << "glossy part, estimator " << estimator << " sampler " << sampler;
            worst_error = std::max(worst_error, means.whole.standard_error / means.whole.mean);
        }
    std::printf("largest standard error of a mean: %.2f%%\n", 100.0 * worst_error);
    // Negative control: what the least precise of them would find of a lamp 25% brighter, the most precise of one 1%.
    EXPECT_GT(0.25 / worst_error, bound);
    EXPECT_GT(std::abs(deviation(reference.whole, 1.01 * reference.whole.mean)), bound);
}

INSTANTIATE_TEST_SUITE_P(PathLengths, EstimatorMeans, testing::Values(2U, 3U),
                         [](const auto &param) { return "Of" + std::to_string(param.param); });

// ---- Uneven lamps ------------------------------------------------------------------------------------------------

const std::vector<FloorLamp> ratio_1e8 = {{{0, 50, -6}, 0.5, 1e8}, {{2, 1, -6}, 0.2, 1.0}};

// Emission from 1 to 7 on a grid of 64 x 64.
std::vector<FloorLamp> lamp_grid() {
    std::vector<FloorLamp> lamps;
    for (int i = 0; i < 64; ++i)
        for (int j = 0; j < 64; ++j)
            lamps.push_back({{-15.75 + 0.5 * i, 5, -21.75 + 0.5 * j}, 0.05, 1.0 + (64 * i + j) % 7});
    return lamps;
}

// The closed form against values that were found independently, by quadrature and by a double precision path tracer.
TEST(EstimatorClosedForm, MatchesTabulatedPixels) {
    EXPECT_NEAR(floor_radiance(ratio_1e8, 256, 128, 128, 82) / 7689.269109061732, 1.0, 1e-9);
    EXPECT_NEAR(floor_radiance(ratio_1e8, 256, 128, 60, 100) / 7620.5919949813815, 1.0, 1e-9);
    const FloorLamp dim[] = {ratio_1e8[1]};
    EXPECT_NEAR(floor_radiance(dim, 256, 128, 128, 82) / 0.002876759225824044, 1.0, 1e-9);
    EXPECT_NEAR(floor_radiance(dim, 256, 128, 140, 82) / 0.0046165160817725, 1.0, 1e-9);
    const std::vector<FloorLamp> grid = lamp_grid();
    EXPECT_NEAR(floor_radiance(grid, 256, 128, 128, 85, 2) / 0.13669526730396428, 1.0, 1e-7);
    EXPECT_NEAR(floor_radiance(grid, 256, 128, 90, 95, 2) / 0.13555393553969597, 1.0, 1e-7);
}

TEST_F(Estimator, FindsBothLampsOfRatio1e8) {
    const ListedScene open = floor_under(ratio_1e8);
    set_up(open.scene(), CourseworkScene::camera());
    pt_render render = render_of(32, 16, 2);
    const Batches batches = render_batches(render, 16, 64);
    for (std::size_t row = 10; row < 16; ++row)
        for (std::size_t column = 0; column < 32; column += 6) { // none under the dim lamp, which shadows the floor
            const double expected =
                floor_radiance(ratio_1e8, 32, 16, static_cast<uint32_t>(column), static_cast<uint32_t>(row));
            EXPECT_LT(std::abs(deviation(estimate_of_pixel(batches, 32 * row + column), expected)), allowed(16))
                << column << ", " << row;
        }
}

// A black ball hides the bright lamp from the middle of the floor, which only the dim one lights. With two lamps each
// is sampled at every vertex; with dark company there are enough to choose among.
TEST_F(Estimator, FindsTheDimLampWhereTheBrightOneIsHidden) {
    for (const bool with_company : {false, true}) {
        std::vector<FloorLamp> lamps = ratio_1e8;
        if (with_company)
            for (int i = 0; i < 4; ++i) // together 1e-5 of the dim one's light
                lamps.push_back({{3.0 * i - 5.0, 40.0, -30.0}, 0.001, 1.0});
        ListedScene eclipsed = floor_under(lamps);
        eclipsed.materials.push_back(diffuse(0));
        eclipsed.spheres.push_back({{0, 5, -6}, 2, {0, 0, 0}, static_cast<uint32_t>(eclipsed.materials.size()) - 1, 0});
        set_up(eclipsed.scene(), CourseworkScene::camera());
        const pt_render render = render_of(32, 16, 2);
        const Batches batches = render_batches(render, 16, with_company ? 2048 : 64);
        const std::vector<FloorLamp> lit(lamps.begin() + 1, lamps.end());
        for (const uint32_t column : {16U, 17U}) { // in the umbra: 2.2 about the point under the ball
            const Estimate estimate = estimate_of_pixel(batches, 32 * 10 + column);
            const double expected = floor_radiance(lit, 32, 16, column, 10);
            EXPECT_LT(std::abs(deviation(estimate, expected)), allowed(16)) << column << " company " << with_company;
            EXPECT_LT(estimate.standard_error, 0.01 * expected) << "too noisy to tell anything";
        }
    }
}

// 64 lamps over six decades, most off-screen, chosen one at a vertex.
TEST_F(Estimator, WeighsManyUnevenLamps) {
    std::vector<FloorLamp> lamps;
    for (int i = 0; i < 64; ++i)
        lamps.push_back({{-14.0 + 4.0 * (i % 8), 2.0 + 0.1 * i, 8.0 - 4.0 * (i / 8)},
                         0.05 + 0.002 * i,
                         std::pow(10.0, (i * 29 % 64) * 6.0 / 63.0)});
    const ListedScene listed = floor_under(lamps);
    set_up(listed.scene(), CourseworkScene::camera());
    const pt_render render = render_of(16, 8, 2);
    const Batches batches = render_batches(render, 16, 256);
    for (std::size_t row = 5; row < 8; ++row)
        for (std::size_t column = 0; column < 16; ++column) {
            const double expected =
                floor_radiance(lamps, 16, 8, static_cast<uint32_t>(column), static_cast<uint32_t>(row), 32);
            const Estimate estimate = estimate_of_pixel(batches, 16 * row + column);
            EXPECT_LT(std::abs(deviation(estimate, expected)), allowed(16)) << column << ", " << row;
            EXPECT_LT(estimate.standard_error, 0.01 * expected) << "too noisy to tell anything";
        }
}

// ---- Russian roulette ----------------------------------------------------------------------------------------------

// A lamp of radius 1 and radiance 100 in the middle of a diffuse shell of radius 10 and albedo 1/2. A wall point sees
// the lamp in the share q = (r / R)^2 of its directions by the cosine, and else the wall, which is the same
// everywhere: radiance = rho Le q sum over j <= L - 2 of (rho (1 - q))^j.
double enclosure(uint32_t max_path_length) {
    constexpr double q = 0.01;
    double sum = 0.0;
    for (uint32_t j = 0; j + 2 <= max_path_length; ++j)
        sum += std::pow(0.5 * (1.0 - q), j);
    return 0.5 * 100.0 * q * sum;
}

TEST_F(Estimator, RouletteIsUnbiased) {
    EXPECT_NEAR(enclosure(64), 0.99009900990, 1e-11);
    EXPECT_NEAR(enclosure(10), 0.988332462, 1e-9);
    const ListedScene shell{
        {diffuse(0.5F), lamp(100)}, {{{0, 0, -2}, 1, {0, 0, 0}, 1, 0}, {{0, 0, -2}, 10, {0, 0, 0}, 0, 0}}, {}};
    set_up(shell.scene(), CourseworkScene::camera());
    // The lamp, 3 away, covers what is within tan(asin(1/3)) = 0.354 of the image's middle, in units of its height 1:
    // the first 4 and last 4 columns of 16, beyond 0.5, show the wall alone.
    std::vector<std::size_t> wall;
    for (std::size_t pixel = 0; pixel < 128; ++pixel)
        if (pixel % 16 < 4 || pixel % 16 >= 12)
            wall.push_back(pixel);
    constexpr uint32_t batch_count = 32;
    for (const uint32_t sampler : {PT_SAMPLER_RANDOM, PT_SAMPLER_SOBOL})
        for (const uint32_t length : {7U, 8U, 64U}) { // from 8 on with roulette; shorter ones: tests/analytic
            pt_render render = render_of(16, 8, length);
            render.sampler = sampler;
            const Estimate estimate = estimate_over(render_batches(render, batch_count, 128), wall);
            EXPECT_LT(std::abs(deviation(estimate, enclosure(length))), allowed(batch_count))
                << "path length " << length << " sampler " << sampler << ": " << estimate.mean;
            // Negative control: one vertex less must show, except where random roulette is too noisy for it.
            if (length <= 7 || (length == 8 && sampler == PT_SAMPLER_SOBOL)) {
                EXPECT_GT(std::abs(deviation(estimate, enclosure(length - 1))), allowed(batch_count));
            }
            std::printf("path length %u, sampler %u: off by %.1e, standard error %.1e\n", length, sampler,
                        estimate.mean - enclosure(length), estimate.standard_error);
        }
}

} // namespace
