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

constexpr double false_alarms = 1e-6;
constexpr double comparisons = 1000;
double allowed(std::size_t batch_count) {
    return student_bound(false_alarms / comparisons, batch_count);
}

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

// The lamp is so large that every estimator has a finite variance.
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
    Estimate whole;
    Estimate glossy_part;
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
    // Negative control: the lamp is brighter by 25% for the least precise estimator, or by 1% for the most precise one.
    EXPECT_GT(0.25 / worst_error, bound);
    EXPECT_GT(std::abs(deviation(reference.whole, 1.01 * reference.whole.mean)), bound);
}

INSTANTIATE_TEST_SUITE_P(PathLengths, EstimatorMeans, testing::Values(2U, 3U),
                         [](const auto &param) { return "Of" + std::to_string(param.param); });

} // namespace
