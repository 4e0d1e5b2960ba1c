#include "tests/support/context_calls.h"
#include "tests/support/context_fixture.h"
#include "tests/support/scene_of.h"
#include "tests/support/sized.h"

#include <pt/film.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <utility>
#include <vector>

namespace unknown_error {

namespace {

constexpr uint32_t width = 32;
constexpr uint32_t height = 32;

// The floor fills the image. A lamp 100 above it covers radius^2 / 40000 of all directions.
class UnknownError : public ContextFixture {
protected:
    void set_up(double lamp_radius, uint32_t estimator, uint32_t max_path_length = 2,
                const std::array<double, 3> &place = {0.0, 100.0, 0.0}, double depth = 1.0, float glossiness = 0.0F) {
        const float specular = glossiness > 0.0F ? 0.5F : 0.0F;
        const pt_material materials[] = {{{0.5F, 0.5F, 0.5F}, {specular, specular, specular}, {}, glossiness, 0},
                                         {{}, {}, {100.0F, 100.0F, 100.0F}, 0.0F, 0}};
        const pt_sphere lamp[] = {{{place[0], place[1], place[2]}, lamp_radius, {}, 1, 0}};
        const pt_plane floor[] = {{{0.0, 1.0, 0.0}, depth, 0, 0}};
        const pt_scene scene = scene_of(materials, lamp, floor);
        const pt_camera camera = camera_at({0, 0, 0}, {0, -1, 0}, 1.0, {0, 0, 1});
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

// A ray hits the lamp with the probability 1/100. The 1024 pixels have 164 hits with 16 samples, and 2,620 with 256.
// The error is known from 1,000 hits on.
TEST_F(UnknownError, WhileALampIsHardlyMetByChance) {
    for (const uint32_t estimator : {PT_ESTIMATOR_UNIFORM, PT_ESTIMATOR_COSINE, PT_ESTIMATOR_BSDF}) {
        set_up(20.0, estimator);
        EXPECT_EQ(after(16) & unmet, unmet) << estimator;
        EXPECT_EQ(after(240) & unmet, 0U) << estimator;
    }
    for (const uint32_t estimator : {PT_ESTIMATOR_LIGHT, PT_ESTIMATOR_MIS}) {
        set_up(20.0, estimator);
        EXPECT_EQ(after(16) & unmet, 0U) << estimator;
    }
    set_up(20.0, PT_ESTIMATOR_BSDF, 1);
    EXPECT_EQ(after(16) & unmet, 0U);
}

// About one in 1,000,000 directions at the floor lies in its specular lobe.
TEST_F(UnknownError, WhileALobeIsHardlyMetByChance) {
    for (const uint32_t estimator : {PT_ESTIMATOR_UNIFORM, PT_ESTIMATOR_COSINE, PT_ESTIMATOR_BSDF}) {
        set_up(50.0, estimator, 2, {0.0, 100.0, 0.0}, 1.0, 1e6F);
        EXPECT_EQ(after(240) & unmet, estimator == PT_ESTIMATOR_BSDF ? 0U : unmet) << estimator;
    }
}

double lamp_of(double pixels) {
    return 10.0 * 2.0 * std::tan(0.5) / height * std::sqrt(pixels / 3.14159);
}

// A visible lamp that covers a 20th of a pixel gets .8 hits of 16 samples, and 13 hits of 256. Its light on other
// surfaces is negligible.
TEST_F(UnknownError, WhileSamplesHardlyMeetALampInView) {
    for (const bool in_view : {false, true}) {
        set_up(lamp_of(1.0 / 20), PT_ESTIMATOR_MIS, 2, {in_view ? 0.0 : 6.0, -10.0, 0.0}, 20.0);
        EXPECT_EQ(after(16) & unmet, in_view ? unmet : 0U);
        EXPECT_EQ(after(240) & unmet, 0U);
    }
    const pt_camera away = camera_at({0, 0, 0}, {0, 1, 0}, 1.0, {0, 0, 1});
    ASSERT_EQ(pt_set_camera(context(), &away), PT_OK) << pt_last_error(context());
    EXPECT_EQ(after(16) & unmet, 0U) << "no longer in view";
}

TEST_F(UnknownError, NoTargetIsReachedBeforeALampInViewIsMet) {
    for (const auto &[sampling, needed] : {std::pair{PT_SAMPLING_UNIFORM, 60U},
                                           {PT_SAMPLING_UNIFORM, 120U},
                                           {PT_SAMPLING_ADAPTIVE, 60U},
                                           {PT_SAMPLING_ADAPTIVE, 120U}}) {
        set_up(lamp_of(3.0 / needed), PT_ESTIMATOR_MIS, 1, {0.0, -10.0, 0.0}, 20.0);
        pt_accumulate_info info = accumulate_info(32, 10.0);
        info.sampling = sampling;
        EXPECT_EQ(pt_accumulate(context(), &info), PT_OK);
        EXPECT_EQ(stats_of(context()).max_sample_count, 32U);
        const std::vector<char> film = film_of(context());
        info.sample_count = 1000;
        EXPECT_EQ(pt_accumulate(context(), &info), PT_TARGET_REACHED);
        EXPECT_GE(stats_of(context()).max_sample_count, needed);
        const std::vector<float> image = values_of(context(), std::size_t{width} * height);
        EXPECT_GT(*std::ranges::max_element(image), 0.0F);

        pt_film *opened = nullptr;
        ASSERT_EQ(pt_open_film(film.data(), film.size(), &opened), PT_OK) << pt_last_error(nullptr);
        auto film_info = sized<pt_film_info>();
        EXPECT_EQ(pt_get_film_info(opened, &film_info), PT_OK);
        EXPECT_EQ(film_info.lamp_sample_count, needed);
        std::array<uint32_t, 16> goals{};
        uint32_t count = goals.size();
        EXPECT_EQ(pt_plan_film(opened, info.stopping.target_error, 1000, goals.data(), &count), PT_PENDING);
        EXPECT_EQ(std::ranges::max(goals), 64U);
        pt_close_film(opened);
    }
}

} // namespace

} // namespace unknown_error
