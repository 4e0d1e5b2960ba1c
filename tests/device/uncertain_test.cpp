// pt_error_estimate.uncertain: where the error cannot be known, and why.
#include "tests/support/context_calls.h"
#include "tests/support/context_fixture.h"
#include "tests/support/scene_of.h"

#include <array>
#include <cmath>
#include <cstdint>
#include <limits>

namespace uncertain {

namespace {

constexpr uint32_t width = 32;
constexpr uint32_t height = 32;

// The floor fills the image, 100 below a lamp that covers radius^2 / 40000 of all directions.
class UncertainTest : public ContextFixture {
protected:
    void set_up(double lamp_radius, uint32_t estimator, uint32_t max_path_length = 2,
                const std::array<double, 3> &place = {0.0, 100.0, 0.0}, double depth = 1.0, float glossiness = 0.0F) {
        const float specular = glossiness > 0.0F ? 0.5F : 0.0F;
        const pt_material materials[] = {{{0.5F, 0.5F, 0.5F}, {specular, specular, specular}, {}, glossiness, 0},
                                         {{}, {}, {100.0F, 100.0F, 100.0F}, 0.0F, 0}};
        const pt_sphere lamp[] = {{{place[0], place[1], place[2]}, lamp_radius, {}, 1, 0}};
        const pt_plane floor[] = {{{0.0, 1.0, 0.0}, depth, 0, 0}};
        const pt_scene scene = scene_of(materials, lamp, floor);
        pt_camera camera{};
        camera.struct_size = sizeof camera;
        camera.shutter_close = 1;
        camera.target[1] = -1.0;
        camera.up[2] = 1.0;
        camera.vertical_fov = 1.0;
        pt_render render = render_of(width, height, max_path_length);
        render.estimator = estimator;
        set_picture(context(), scene, camera, render);
    }

    uint32_t after(uint32_t sample_count) {
        accumulate(sample_count);
        return error().uncertain;
    }
};

constexpr uint32_t unmet = PT_UNCERTAIN_UNMET;

// 16 samples of 1024 pixels hit a lamp of a hundredth 164 times, 256 samples 2,620 times.
TEST_F(UncertainTest, WhileALampIsHardlyMetByChance) {
    for (const uint32_t estimator : {PT_ESTIMATOR_UNIFORM, PT_ESTIMATOR_COSINE, PT_ESTIMATOR_BSDF}) {
        set_up(20.0, estimator);
        EXPECT_EQ(after(16) & unmet, unmet) << estimator;
        EXPECT_EQ(after(240) & unmet, 0U) << estimator;
    }
    for (const uint32_t estimator : {PT_ESTIMATOR_LIGHT, PT_ESTIMATOR_MIS}) {
        set_up(20.0, estimator);
        EXPECT_EQ(after(16) & unmet, 0U) << estimator;
    }
    set_up(20.0, PT_ESTIMATOR_BSDF, 1); // no directions that could hit it
    EXPECT_EQ(after(16) & unmet, 0U);
}

// About one direction in 1,000,000 from the floor hits its lobe.
TEST_F(UncertainTest, WhileALobeIsHardlyMetByChance) {
    for (const uint32_t estimator : {PT_ESTIMATOR_UNIFORM, PT_ESTIMATOR_COSINE, PT_ESTIMATOR_BSDF}) {
        set_up(50.0, estimator, 2, {0.0, 100.0, 0.0}, 1.0, 1e6F);
        EXPECT_EQ(after(240) & unmet, estimator == PT_ESTIMATOR_BSDF ? 0U : unmet) << estimator;
    }
}

// 16 samples hit a 20th of a pixel .8 times, 256 samples 13 times. Beside the view it does not count.
TEST_F(UncertainTest, WhileSamplesHardlyMeetALampInView) {
    const double pixel = 2.0 * std::tan(0.5) / height; // at distance 1
    for (const bool in_view : {true, false}) {
        set_up(10.0 * pixel * std::sqrt(0.05 / 3.14159), PT_ESTIMATOR_MIS, 2, {in_view ? 0.0 : 6.0, -10.0, 0.0}, 20.0);
        EXPECT_EQ(after(16) & unmet, in_view ? unmet : 0U);
        EXPECT_EQ(after(240) & unmet, 0U);
    }
}

// A lamp of 2.5e-9 is never hit: black parts agree without evidence.
TEST_F(UncertainTest, NothingIsKnownOfAPictureThatIsBlackByChance) {
    set_up(0.01, PT_ESTIMATOR_BSDF);
    EXPECT_EQ(after(16), unmet);
    EXPECT_EQ(error().relative_rmse_high, std::numeric_limits<double>::infinity());
    set_up(0.01, PT_ESTIMATOR_MIS);
    EXPECT_EQ(after(16) & unmet, 0U);
    EXPECT_TRUE(std::isfinite(error().relative_rmse_high));
}

} // namespace

} // namespace uncertain
