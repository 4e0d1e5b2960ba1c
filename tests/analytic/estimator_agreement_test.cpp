// Every way of finding light has the same mean, in scenes where all have a finite variance. Run alone with
// --gtest_filter=EstimatorAgreement*.
#include "tests/analytic/analytic_fixture.h"
#include "tests/analytic/scenes.h"
#include "tests/support/batch_fixture.h"
#include "tests/support/scene_of.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdint>
#include <cstdio>
#include <string>
#include <vector>

namespace {

using namespace analytic;

constexpr std::uint32_t estimator_batch_count = 24;
constexpr std::uint32_t width = 32;
constexpr std::uint32_t height = 16;

class EstimatorAgreement : public AnalyticFixture, public testing::WithParamInterface<const char *> {
protected:
    static pt_render render_of(std::uint32_t max_path_length, std::uint32_t estimator) {
        pt_render render = ::render_of(width, height, max_path_length);
        render.estimator = estimator;
        render.seed = 1000 * estimator; // batches of different estimators are independent
        return render;
    }

    // The pixels that show no emission themselves: those of the lamps would dilute the difference.
    std::vector<std::size_t> lit_pixels() {
        const Batches emission = render_batches(render_of(1, PT_ESTIMATOR_BEST), 1, 64);
        std::vector<std::size_t> lit;
        for (std::size_t pixel = 0; pixel < emission[0].size(); ++pixel)
            if (emission[0][pixel] == 0.0)
                lit.push_back(pixel);
        return lit;
    }
};

// Five standard errors, as multiples of the normal distribution: one false alarm in 2 million per comparison; 5 scenes
// of 4 comparisons with the degrees of freedom of 24 batches: the quantile of Student's t for that.
const double estimator_bound = student_bound(std::erfc(5.0 / std::sqrt(2.0)), estimator_batch_count);

TEST_P(EstimatorAgreement, OfAll) {
    cli::SceneFile scene = read_scene(GetParam());
    set_up(scene.scene(), scene.camera);
    const std::vector<std::size_t> lit = lit_pixels();
    ASSERT_GT(lit.size(), 50U);
    const Estimate mis = estimate_over(render_batches(render_of(2, PT_ESTIMATOR_MIS), estimator_batch_count, 256), lit);
    double worst_error = 0.0;
    for (const std::uint32_t estimator :
         {PT_ESTIMATOR_LIGHT, PT_ESTIMATOR_BSDF, PT_ESTIMATOR_COSINE, PT_ESTIMATOR_UNIFORM}) {
        const Estimate other = estimate_over(render_batches(render_of(2, estimator), estimator_batch_count, 256), lit);
        const double error = std::hypot(mis.standard_error, other.standard_error, 1e-6 * mis.mean);
        std::printf("%s, estimator %u: %.6f +- %.6f, mis %.6f +- %.6f, deviation %.2f\n", GetParam(), estimator,
                    other.mean, other.standard_error, mis.mean, mis.standard_error, (other.mean - mis.mean) / error);
        EXPECT_LT(std::abs(other.mean - mis.mean), estimator_bound * error) << "estimator " << estimator;
        worst_error = std::max(worst_error, error);
    }
    // Negative control: lamps brighter by what the noisiest comparison must see.
    const double excess = std::max(0.03, 2.0 * estimator_bound * worst_error / mis.mean);
    brighten(scene, static_cast<float>(1.0 + excess));
    set_up(scene.scene(), scene.camera);
    const Estimate brighter =
        estimate_over(render_batches(render_of(2, PT_ESTIMATOR_MIS), estimator_batch_count, 256), lit);
    EXPECT_GT(std::abs(brighter.mean - mis.mean), estimator_bound * worst_error);
    std::printf("%s: sees lamps %.1f%% brighter\n", GetParam(), 100.0 * excess);
    EXPECT_LT(excess, 0.3) << "too noisy to tell anything";
}

INSTANTIATE_TEST_SUITE_P(Scenes, EstimatorAgreement,
                         testing::Values("01-above", "02-horizon", "12-phong-furnace-n0", "12-phong-furnace-n40",
                                         "14-gloss-n10", "14-gloss-n40", "30-terminator"),
                         [](const auto &param) {
                             std::string name = param.param;
                             for (char &c : name)
                                 c = std::isalnum(static_cast<unsigned char>(c)) ? c : '_';
                             return "Scene" + name;
                         });

} // namespace
