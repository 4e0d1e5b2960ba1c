#include "tests/api/api_fixture.h"
#include "tests/support/image_target.h"
#include "tests/support/scene_of.h"

#include <pt/devices.h>

#include <algorithm>
#include <chrono>
#include <cstring>
#include <limits>
#include <stdexcept>
#include <thread>
#include <utility>
#include <vector>

namespace api {

namespace {

TEST_F(ApiTest, AccumulateNeedsEverySetting) {
    const pt_scene scene = valid_scene();
    const pt_camera camera = valid_camera();
    const pt_render render = valid_render();
    const pt_accumulate_info info = samples(1);
    const auto missing = [&](const std::string &expected) {
        expect_failure(pt_accumulate(context(), &info), PT_ERROR_INVALID_STATE, expected);
        expect_failure(pt_prepare(context()), PT_ERROR_INVALID_STATE, expected);
        std::vector<float> pixels(width * height * 3, -1.0F);
        const pt_image target = tight_image(pixels);
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

TEST_F(ApiTest, SampleIndicesEndAt32Bits) {
    set_all();
    pt_render render = valid_render();
    render.first_sample = UINT32_MAX - 1;
    ASSERT_EQ(pt_set_render(context(), &render), PT_OK) << message();
    pt_accumulate_info info = samples(3);
    EXPECT_EQ(pt_accumulate(context(), &info), PT_ERROR_INVALID_ARGUMENT);
    EXPECT_EQ(message().rfind("accumulate.sample_count = 3: ", 0), 0U) << message();
    accumulate(2);
    expect_image(2);
    info.sample_count = 1;
    EXPECT_EQ(pt_accumulate(context(), &info), PT_ERROR_INVALID_ARGUMENT);
    expect_image(2);
}

TEST_F(ApiTest, PixelsHoldAtMost32BitsOfSamples) {
    set_all();
    accumulate(1);
    const pt_accumulate_info info = samples(UINT32_MAX);
    expect_failure(pt_accumulate(context(), &info), PT_ERROR_INVALID_ARGUMENT,
                   "accumulate.sample_count = 4294967295: a pixel holds at most 2^32 - 1 samples (it has 1)");
    expect_image(1);
}

TEST_F(ApiTest, TellsItsDevice) {
    pt_device_info device{};
    ASSERT_EQ(pt_get_context_device(context(), &device), PT_OK) << message();
    EXPECT_EQ(device.suitable, 1U);
    uint32_t count = 0;
    ASSERT_EQ(pt_get_devices(nullptr, &count), PT_OK);
    std::vector<pt_device_info> devices(count);
    ASSERT_EQ(pt_get_devices(devices.data(), &count), PT_OK);
    EXPECT_TRUE(std::any_of(devices.begin(), devices.end(), [&](const pt_device_info &other) {
        return std::memcmp(other.uuid, device.uuid, sizeof device.uuid) == 0 &&
               std::string(other.name) == device.name && other.kind == device.kind;
    }));
}

TEST_F(ApiTest, FailedCallsChangeNothing) {
    set_all();
    accumulate(3);

    pt_sphere broken_sphere = sphere;
    broken_sphere.radius = -1;
    pt_scene scene = valid_scene();
    scene.spheres = &broken_sphere;
    expect_failure(pt_set_scene(context(), &scene), PT_ERROR_INVALID_SCENE, "spheres[0].radius = -1: must be > 0");
    expect_image(3);

    pt_camera camera = valid_camera();
    camera.target[2] = 0;
    expect_failure(pt_set_camera(context(), &camera), PT_ERROR_INVALID_ARGUMENT,
                   "camera.target = (0, 0, 0): must differ from position");
    expect_image(3);

    pt_render render = valid_render();
    render.width = 0;
    expect_failure(pt_set_render(context(), &render), PT_ERROR_INVALID_ARGUMENT, "render.width = 0: must be >= 1");
    expect_image(3);

    const pt_accumulate_info nothing = samples(0);
    expect_failure(pt_accumulate(context(), &nothing), PT_ERROR_INVALID_ARGUMENT,
                   "accumulate.sample_count = 0: must be >= 1 without a target_error");
    expect_image(3);

    pt_accumulate_info aimless = samples(1);
    for (const auto &[target, value] : {std::pair{-0.5, "-0.5"},
                                        {std::numeric_limits<double>::infinity(), "inf"},
                                        {std::numeric_limits<double>::quiet_NaN(), "nan"}}) {
        aimless.stopping.target_error = target;
        expect_failure(pt_accumulate(context(), &aimless), PT_ERROR_INVALID_ARGUMENT,
                       std::string("stopping.target_error = ") + value + ": must be finite and >= 0");
    }
    expect_image(3);

    accumulate(2);
    expect_image(5);
}

TEST_F(ApiTest, MessageStaysUntilTheNextFailure) {
    EXPECT_EQ(message(), "");
    EXPECT_EQ(pt_set_scene(context(), nullptr), PT_ERROR_INVALID_ARGUMENT);
    EXPECT_EQ(message(), "scene = NULL: must not be NULL");
    set_all();
    EXPECT_EQ(message(), "scene = NULL: must not be NULL");
    EXPECT_EQ(pt_set_camera(context(), nullptr), PT_ERROR_INVALID_ARGUMENT);
    EXPECT_EQ(message(), "camera = NULL: must not be NULL");
}

TEST_F(ApiTest, MessagesBelongToTheirContext) {
    const Context other = create_context();
    ASSERT_TRUE(other);
    ASSERT_EQ(pt_create(nullptr, nullptr), PT_ERROR_INVALID_ARGUMENT);
    EXPECT_EQ(pt_set_scene(context(), nullptr), PT_ERROR_INVALID_ARGUMENT);
    EXPECT_EQ(message(), "scene = NULL: must not be NULL");
    EXPECT_STREQ(pt_last_error(other.get()), "");
    EXPECT_STREQ(pt_last_error(nullptr), "context = NULL: must not be NULL");
}

struct Progress {
    std::vector<double> fractions;
    bool elsewhere = false;
    std::thread::id thread = std::this_thread::get_id();

    static int32_t call(void *user, double fraction) {
        auto &progress = *static_cast<Progress *>(user);
        progress.fractions.push_back(fraction);
        progress.elsewhere = progress.elsewhere || std::this_thread::get_id() != progress.thread;
        return 0;
    }
};

TEST_F(ApiTest, ProgressRisesToOneOnTheCallingThread) {
    set_all();
    Progress progress;
    const pt_accumulate_info info = accumulate_info(5000, 0.0, &Progress::call, &progress);
    ASSERT_EQ(pt_accumulate(context(), &info), PT_OK) << message();
    ASSERT_FALSE(progress.fractions.empty());
    EXPECT_TRUE(std::is_sorted(progress.fractions.begin(), progress.fractions.end()));
    EXPECT_GE(progress.fractions.front(), 0.0);
    EXPECT_EQ(progress.fractions.back(), 1.0);
    EXPECT_FALSE(progress.elsewhere);
}

TEST_F(ApiTest, TheErrorIsKnownFrom16Samples) {
    set_all();
    constexpr double infinity = std::numeric_limits<double>::infinity();
    for (const uint32_t more : {0U, 15U}) {
        if (more > 0)
            accumulate(more);
        const pt_error_estimate unknown = error();
        EXPECT_EQ(unknown.rmse, infinity);
        EXPECT_EQ(unknown.rmse_low, 0.0);
        EXPECT_EQ(unknown.rmse_high, infinity);
        EXPECT_EQ(unknown.relative_rmse, infinity);
        EXPECT_EQ(unknown.relative_rmse_low, 0.0);
        EXPECT_EQ(unknown.relative_rmse_high, infinity);
    }
    pt_accumulate_info info = samples(100);
    info.stopping.target_error = 1e-6;
    ASSERT_EQ(pt_accumulate(context(), &info), PT_TARGET_REACHED) << message();
    expect_image(16);
    const pt_error_estimate known = error();
    EXPECT_EQ(known.rmse, 0.0);
    EXPECT_EQ(known.relative_rmse_high, 0.0);
    ASSERT_EQ(pt_accumulate(context(), &info), PT_TARGET_REACHED) << message();
    expect_image(16);
    info.stopping.target_error = 0.0;
    ASSERT_EQ(pt_accumulate(context(), &info), PT_OK) << message();
    expect_image(116);
}

TEST_F(ApiTest, ATimeLimitKeepsCompleteSamplesAndAtLeastOne) {
    set_all();
    pt_accumulate_info info = samples(1U << 30);
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
    info.stopping.time_limit = -1.0;
    expect_failure(pt_accumulate(context(), &info), PT_ERROR_INVALID_ARGUMENT,
                   "stopping.time_limit = -1: must be finite and >= 0");
    const std::vector<uint32_t> of_tiles(3, 1);
    info.stopping.time_limit = 0.0;
    info.tile_samples = of_tiles.data();
    info.tile_count = static_cast<uint32_t>(of_tiles.size());
    expect_failure(pt_accumulate(context(), &info), PT_ERROR_INVALID_ARGUMENT,
                   "stopping.target_error = 1e+09: must be 0 with tile_samples");
}

TEST_F(ApiTest, ProgressThatThrowsIsAnErrorThatKeepsTheFilmWhole) {
    set_all();
    const pt_accumulate_info info = accumulate_info(
        1U << 30, 0.0, [](void *, double) -> int32_t { throw std::runtime_error("thrown by a callback"); });
    expect_failure(pt_accumulate(context(), &info), PT_ERROR_INTERNAL, "thrown by a callback");
    const uint32_t kept = stats().sample_count;
    accumulate(2);
    expect_image(kept + 2);
}

} // namespace

} // namespace api
