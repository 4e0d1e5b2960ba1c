#include "tests/api/api_fixture.h"
#include "tests/support/coursework_scene.h"
#include "tests/support/image_target.h"
#include "tests/support/scene_of.h"

#include <cfenv>
#include <chrono>
#include <limits>
#include <utility>
#include <vector>

namespace api {

namespace {

TEST_F(ApiTest, AccumulateNeedsEverySetting) {
    const pt_scene scene = valid_scene();
    const pt_camera camera = valid_camera();
    const pt_render render = valid_render();
    const pt_accumulate_info info = accumulate_info(1);
    const auto missing = [&](const std::string &expected) {
        expect_failure(pt_accumulate(context(), &info), PT_ERROR_INVALID_STATE, expected);
        expect_failure(pt_prepare(context()), PT_ERROR_INVALID_STATE, expected);
        std::vector<float> pixels(width * height * 3, -1.0F);
        const pt_image target = image_target(pixels);
        expect_failure(pt_readback(context(), &target), PT_ERROR_INVALID_STATE, expected);
        EXPECT_EQ(pixels, std::vector<float>(pixels.size(), -1.0F));
    };
    missing("no scene: call pt_set_scene first");
    ASSERT_EQ(pt_set_scene(context(), &scene), PT_OK);
    missing("no camera: call pt_set_camera first");
    ASSERT_EQ(pt_set_camera(context(), &camera), PT_OK);
    missing("no render settings: call pt_set_render first");
    ASSERT_EQ(pt_set_render(context(), &render), PT_OK);
    EXPECT_EQ(pt_prepare(context()), PT_OK) << message();
    EXPECT_EQ(stats().sample_count, 0U);
    EXPECT_EQ(pt_accumulate(context(), &info), PT_OK) << message();
}

TEST_F(ApiTest, ReadbackNeedsSamples) {
    set_all();
    pt_render render = valid_render();
    render.flags = PT_RENDER_COVERAGE;
    ASSERT_EQ(pt_set_render(context(), &render), PT_OK);
    for (const uint32_t quantity : {PT_QUANTITY_RADIANCE, PT_QUANTITY_STANDARD_ERROR, PT_QUANTITY_COVERAGE}) {
        std::vector<float> pixels(width * height * 3, -1.0F);
        const pt_image target = image_target(pixels, quantity);
        expect_failure(pt_readback(context(), &target), PT_ERROR_INVALID_STATE,
                       "no samples yet: call pt_accumulate or pt_add_film first");
        EXPECT_EQ(pixels, std::vector<float>(pixels.size(), -1.0F));
    }
}

TEST_F(ApiTest, EachSetterDiscardsTheSamples) {
    const pt_scene scene = valid_scene();
    const pt_camera camera = valid_camera();
    const pt_render render = valid_render();
    set_all();
    for (int setter = 0; setter < 3; ++setter) {
        accumulate(2);
        EXPECT_EQ(stats().sample_count, 2U);
        const pt_result result = setter == 0   ? pt_set_scene(context(), &scene)
                                 : setter == 1 ? pt_set_camera(context(), &camera)
                                               : pt_set_render(context(), &render);
        EXPECT_EQ(result, PT_OK) << message();
        EXPECT_EQ(stats().sample_count, 0U) << "setter " << setter;
    }
}

TEST_F(ApiTest, SampleIndicesAndCountsEndAt32Bits) {
    set_all();
    accumulate(1);
    pt_accumulate_info info = accumulate_info(UINT32_MAX);
    expect_failure(pt_accumulate(context(), &info), PT_ERROR_INVALID_ARGUMENT,
                   "accumulate.sample_count = 4294967295: a pixel holds at most 2^32 - 1 samples (it has 1)");
    expect_image(1);
    pt_render render = valid_render();
    render.first_sample = UINT32_MAX - 1;
    ASSERT_EQ(pt_set_render(context(), &render), PT_OK) << message();
    info.sample_count = 3;
    EXPECT_EQ(pt_accumulate(context(), &info), PT_ERROR_INVALID_ARGUMENT);
    EXPECT_TRUE(message().starts_with("accumulate.sample_count = 3: ")) << message();
    accumulate(2);
    info.sample_count = 1;
    EXPECT_EQ(pt_accumulate(context(), &info), PT_ERROR_INVALID_ARGUMENT);
    expect_image(2);
}

TEST_F(ApiTest, FailedCallsChangeNothing) {
    set_all();
    accumulate(3);
    const auto refused = [&](pt_result result, const std::string &expected,
                             pt_result code = PT_ERROR_INVALID_ARGUMENT) {
        expect_failure(result, code, expected);
        expect_image(3);
    };
    pt_sphere broken_sphere = sphere;
    broken_sphere.radius = -1;
    pt_scene scene = valid_scene();
    scene.spheres = &broken_sphere;
    refused(pt_set_scene(context(), &scene), "spheres[0].radius = -1: must be > 0", PT_ERROR_INVALID_SCENE);
    pt_camera camera = valid_camera();
    camera.target[2] = 0;
    refused(pt_set_camera(context(), &camera), "camera.target = (0, 0, 0): must differ from position");
    pt_render render = valid_render();
    render.width = 0;
    refused(pt_set_render(context(), &render), "render.width = 0: must be >= 1");
    pt_accumulate_info info = accumulate_info(0);
    refused(pt_accumulate(context(), &info), "accumulate.sample_count = 0: must be >= 1 without a target_error");
    for (const auto &[target, value] : {std::pair{-0.5, "-0.5"},
                                        {std::numeric_limits<double>::infinity(), "inf"},
                                        {std::numeric_limits<double>::quiet_NaN(), "nan"}}) {
        info = accumulate_info(1, target);
        refused(pt_accumulate(context(), &info),
                std::string("stopping.target_error = ") + value + ": must be finite and >= 0");
    }
    const std::vector<uint32_t> of_tiles(3, 1);
    info = accumulate_info(1, 1e9);
    info.tile_samples = of_tiles.data();
    info.tile_count = static_cast<uint32_t>(of_tiles.size());
    refused(pt_accumulate(context(), &info), "stopping.target_error = 1e+09: must be 0 with tile_samples");
    accumulate(2);
    expect_image(5);
}

TEST_F(ApiTest, AMessageStaysUntilTheNextFailureInItsContext) {
    const Context other = create_context();
    ASSERT_EQ(pt_create(nullptr, nullptr), PT_ERROR_INVALID_ARGUMENT);
    EXPECT_EQ(message(), "");
    EXPECT_EQ(pt_set_scene(context(), nullptr), PT_ERROR_INVALID_ARGUMENT);
    set_all();
    EXPECT_EQ(message(), "scene = NULL: must not be NULL");
    EXPECT_EQ(pt_set_camera(context(), nullptr), PT_ERROR_INVALID_ARGUMENT);
    EXPECT_EQ(message(), "camera = NULL: must not be NULL");
    EXPECT_STREQ(pt_last_error(other.get()), "");
    EXPECT_STREQ(pt_last_error(nullptr), "context = NULL: must not be NULL");
}

TEST_F(ApiTest, TheErrorIsKnownFrom16Samples) {
    set_all();
    constexpr double infinity = std::numeric_limits<double>::infinity();
    for (const uint32_t more : {0U, 15U}) {
        if (more > 0)
            accumulate(more);
        const pt_error_estimate unknown = error();
        for (const double most : {unknown.rmse, unknown.rmse_high, unknown.relative_rmse, unknown.relative_rmse_high})
            EXPECT_EQ(most, infinity);
        EXPECT_EQ(unknown.rmse_low, 0.0);
        EXPECT_EQ(unknown.relative_rmse_low, 0.0);
    }
    pt_accumulate_info info = accumulate_info(100, 1e-6);
    for (int i = 0; i < 2; ++i) {
        ASSERT_EQ(pt_accumulate(context(), &info), PT_TARGET_REACHED) << message();
        expect_image(16);
    }
    EXPECT_EQ(error().rmse, 0.0);
    EXPECT_EQ(error().relative_rmse_high, 0.0);
    accumulate(100);
    expect_image(116);
}

TEST_F(ApiTest, ATimeLimitKeepsCompleteSamplesAndAtLeastOne) {
    set_all();
    pt_accumulate_info info = accumulate_info(1U << 30);
    info.stopping.time_limit = 1e-9;
    ASSERT_EQ(pt_accumulate(context(), &info), PT_LIMIT_REACHED) << message();
    const uint32_t taken = stats().sample_count;
    EXPECT_GE(taken, 1U);
    expect_image(taken);
    info.stopping.time_limit = 0.2;
    const auto start = std::chrono::steady_clock::now();
    ASSERT_EQ(pt_accumulate(context(), &info), PT_LIMIT_REACHED) << message();
    EXPECT_GE(std::chrono::steady_clock::now() - start, std::chrono::milliseconds(200));
    EXPECT_GT(stats().sample_count, taken);
    info.stopping.time_limit = 1e9;
    info.sample_count = 3;
    ASSERT_EQ(pt_accumulate(context(), &info), PT_OK) << message();
    info.stopping.target_error = 1e9;
    info.sample_count = 1U << 30;
    ASSERT_EQ(pt_accumulate(context(), &info), PT_TARGET_REACHED) << message();
}

TEST_F(ApiTest, TheCallersRoundingModeChangesNoBit) {
    const auto outcome_with = [&](int mode) {
        std::fesetround(mode);
        const Context made = create_context([](pt_create_info &info) { info.flags = 0; });
        pt_camera camera = CourseworkScene::camera();
        camera.position[0] = 0.1;
        set_coursework(made.get(), render_of(60, 33, 3), camera);
        accumulate_on(made.get(), 17);
        const std::pair outcome(values_of(made.get(), 60 * 33), error_of(made.get()).rmse);
        EXPECT_EQ(std::fegetround(), mode);
        std::fesetround(FE_TONEAREST);
        return outcome;
    };
    const auto nearest = outcome_with(FE_TONEAREST);
    for (const int mode : {FE_UPWARD, FE_DOWNWARD, FE_TOWARDZERO})
        EXPECT_TRUE(outcome_with(mode) == nearest) << mode;
}

} // namespace

} // namespace api
