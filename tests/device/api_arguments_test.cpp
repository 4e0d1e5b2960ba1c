// The contract of pt.h on a real device: calls without a context, null pointers, and callers compiled with an older
// or a newer header.
#include "tests/device/api_fixture.h"
#include "tests/device/every_call.h"

#include <pt/accuracy.h>
#include <pt/devices.h>
#include <pt/shaders.h>

#include <cstdlib>
#include <cstring>
#include <stdexcept>
#include <thread>

namespace api {

namespace {

// A struct as a caller with a newer header has it: longer by a field.
template <typename T>
struct Newer {
    T known;
    uint64_t unknown;

    explicit Newer(const T &value, uint64_t tail) : known(value), unknown(tail) { known.struct_size = sizeof(Newer); }
};

// ---- No context -----------------------------------------------------------------------------------------------------

TEST(Api, HasTheVersionOfTheHeader) {
    EXPECT_EQ(pt_version(), PT_VERSION);
}

TEST(Api, NamesResults) {
    EXPECT_STREQ(pt_result_name(PT_ERROR_NO_DEVICE), "PT_ERROR_NO_DEVICE");
    EXPECT_STREQ(pt_result_name(1000), "unknown result");
}

TEST(Api, DestroyAllowsNull) {
    pt_destroy(nullptr);
}

TEST(Api, GetDevicesNeedsCount) {
    EXPECT_EQ(pt_get_devices(nullptr, nullptr), PT_ERROR_INVALID_ARGUMENT);
    EXPECT_STREQ(pt_last_error(nullptr), "count = NULL: must not be NULL");
}

TEST(Api, GetDevicesWritesAtMostCount) {
    uint32_t available = 0;
    ASSERT_EQ(pt_get_devices(nullptr, &available), PT_OK) << pt_last_error(nullptr);
    ASSERT_GE(available, 1U);

    std::vector<pt_device_info> devices(available + 1);
    std::memset(devices.data(), 0x55, devices.size() * sizeof(pt_device_info));
    const pt_device_info untouched = devices.back();
    uint32_t count = available + 1;
    ASSERT_EQ(pt_get_devices(devices.data(), &count), PT_OK);
    EXPECT_EQ(count, available);
    EXPECT_EQ(std::memcmp(&devices.back(), &untouched, sizeof untouched), 0);
    for (uint32_t i = 0; i < count; ++i) {
        EXPECT_LE(devices[i].kind, uint32_t{PT_DEVICE_CPU});
        EXPECT_NE(devices[i].name[0], '\0');
        EXPECT_EQ(devices[i].suitable == 1, devices[i].reason[0] == '\0');
    }

    std::memset(devices.data(), 0x55, devices.size() * sizeof(pt_device_info));
    count = available - 1;
    ASSERT_EQ(pt_get_devices(devices.data(), &count), PT_OK);
    EXPECT_EQ(count, available - 1);
    EXPECT_EQ(std::memcmp(&devices[count], &untouched, sizeof untouched), 0);
}

// Creates with info; on failure tells "result name: message" and checks that no context came out.
std::string create_outcome(const pt_create_info *info) {
    pt_context *context = reinterpret_cast<pt_context *>(&context);
    const pt_result result = pt_create(info, &context);
    if (result == PT_OK) {
        EXPECT_NE(context, nullptr);
        pt_destroy(context);
        return "created";
    }
    EXPECT_EQ(context, nullptr);
    return std::string(pt_result_name(result)) + ": " + pt_last_error(nullptr);
}

pt_create_info valid_create() {
    pt_create_info info{};
    info.struct_size = sizeof info;
    info.device = std::getenv("PT_TEST_DEVICE");
    return info;
}

TEST(Api, CreateNeedsAPlaceForTheContext) {
    EXPECT_EQ(pt_create(nullptr, nullptr), PT_ERROR_INVALID_ARGUMENT);
    EXPECT_STREQ(pt_last_error(nullptr), "context = NULL: must not be NULL");
}

TEST(Api, CreateTakesDefaultsOlderAndNewerStructs) {
    EXPECT_EQ(create_outcome(nullptr), "created");
    pt_create_info older = valid_create();
    older.struct_size = offsetof(pt_create_info, submit_milliseconds);
    older.submit_milliseconds = 4000000000U; // behind the struct that the caller knows
    EXPECT_EQ(create_outcome(&older), "created");
    const Newer<pt_create_info> newer(valid_create(), 0);
    EXPECT_EQ(create_outcome(&newer.known), "created");
}

TEST(Api, CreateRefusesWhatItDoesNotKnow) {
    pt_create_info info = valid_create();
    info.flags = 6;
    info.submit_milliseconds = 1001;
    info.reserved = 1;
    EXPECT_EQ(create_outcome(&info), "PT_ERROR_INVALID_ARGUMENT: create.flags = 6: must be a combination of "
                                     "PT_CREATE_* of pt.h\n"
                                     "create.submit_milliseconds = 1001: must be <= 1000\n"
                                     "create.reserved = 1: must be 0");
    info = valid_create();
    info.struct_size = 0;
    EXPECT_EQ(create_outcome(&info), "PT_ERROR_INVALID_ARGUMENT: create.struct_size = 0: must be the size of the "
                                     "struct, which holds this field");
}

TEST(Api, CreateTellsWhyNoDeviceFits) {
    pt_create_info info = valid_create();
    info.device = "no device has such a name";
    const std::string outcome = create_outcome(&info);
    EXPECT_EQ(outcome.rfind("PT_ERROR_NO_DEVICE: ", 0), 0U) << outcome;
    EXPECT_NE(outcome.find(info.device), std::string::npos) << outcome;
}

TEST(Api, MessagesWithoutContextBelongToTheirThread) {
    ASSERT_EQ(pt_create(nullptr, nullptr), PT_ERROR_INVALID_ARGUMENT);
    std::thread([] {
        EXPECT_STREQ(pt_last_error(nullptr), "");
        EXPECT_EQ(pt_get_devices(nullptr, nullptr), PT_ERROR_INVALID_ARGUMENT);
        EXPECT_STREQ(pt_last_error(nullptr), "count = NULL: must not be NULL");
    }).join();
    EXPECT_STREQ(pt_last_error(nullptr), "context = NULL: must not be NULL");
}

TEST(Api, EveryFunctionRefusesANullContext) {
    expect_every_call(outcomes_of_every_call(nullptr), "PT_ERROR_INVALID_ARGUMENT: context = NULL: must not be NULL");
}

// ---- Pointers and struct sizes
// ----------------------------------------------------------------------------------------

TEST_F(ApiTest, RefusesNullPointers) {
    set_all();
    const auto refused = [&](pt_result result, const std::string &name) {
        expect_failure(result, PT_ERROR_INVALID_ARGUMENT, name + " = NULL: must not be NULL");
    };
    refused(pt_set_scene(context(), nullptr), "scene");
    refused(pt_set_camera(context(), nullptr), "camera");
    refused(pt_set_render(context(), nullptr), "render");
    refused(pt_accumulate(context(), nullptr), "accumulate");
    refused(pt_readback(context(), nullptr), "image");
    refused(pt_get_context_device(context(), nullptr), "device");
    refused(pt_get_stats(context(), nullptr), "stats");
    refused(pt_get_accuracy(context(), nullptr, nullptr), "count");
    accumulate(1);
    pt_image no_data{};
    no_data.struct_size = sizeof no_data;
    no_data.size_bytes = 1000000;
    refused(pt_readback(context(), &no_data), "image.data");
}

TEST_F(ApiTest, RefusesForgottenSizes) {
    set_all();
    const auto refused = [&](pt_result result, const std::string &name) {
        expect_failure(result, PT_ERROR_INVALID_ARGUMENT,
                       name + ".struct_size = 0: must be the size of the struct, which holds this field");
    };
    const pt_scene scene{};
    const pt_camera camera{};
    const pt_render render{};
    const pt_accumulate_info info{};
    const pt_image target{};
    pt_stats stats{};
    refused(pt_set_scene(context(), &scene), "scene");
    refused(pt_set_camera(context(), &camera), "camera");
    refused(pt_set_render(context(), &render), "render");
    refused(pt_accumulate(context(), &info), "accumulate");
    refused(pt_readback(context(), &target), "image");
    refused(pt_get_stats(context(), &stats), "stats");
}

TEST_F(ApiTest, AcceptsNewerStructsThatAskForNothingNew) {
    const Newer<pt_scene> scene(valid_scene(), 0);
    const Newer<pt_camera> camera(valid_camera(), 0);
    const Newer<pt_render> render(valid_render(), 0);
    const Newer<pt_accumulate_info> info(samples(2), 0);
    EXPECT_EQ(pt_set_scene(context(), &scene.known), PT_OK) << message();
    EXPECT_EQ(pt_set_camera(context(), &camera.known), PT_OK) << message();
    EXPECT_EQ(pt_set_render(context(), &render.known), PT_OK) << message();
    EXPECT_EQ(pt_accumulate(context(), &info.known), PT_OK) << message();
    std::vector<float> pixels(width * height * 3);
    const Newer<pt_image> target(tight_image(pixels), 0);
    EXPECT_EQ(pt_readback(context(), &target.known), PT_OK) << message();
    expect_image(2);
}

TEST_F(ApiTest, RefusesNewerStructsThatAskForMore) {
    set_all();
    accumulate(1);
    const auto refused = [&](pt_result result, const std::string &name) {
        EXPECT_EQ(result, PT_ERROR_UNSUPPORTED);
        EXPECT_EQ(message().rfind(name + ".struct_size = ", 0), 0U) << message();
    };
    const Newer<pt_scene> scene(valid_scene(), 1);
    const Newer<pt_camera> camera(valid_camera(), 1);
    const Newer<pt_render> render(valid_render(), 1);
    const Newer<pt_accumulate_info> info(samples(1), 1);
    std::vector<float> pixels(width * height * 3);
    const Newer<pt_image> target(tight_image(pixels), 1);
    refused(pt_set_scene(context(), &scene.known), "scene");
    refused(pt_set_camera(context(), &camera.known), "camera");
    refused(pt_set_render(context(), &render.known), "render");
    refused(pt_accumulate(context(), &info.known), "accumulate");
    refused(pt_readback(context(), &target.known), "image");
    expect_image(1);
}

TEST_F(ApiTest, ReadsOlderStructsAsIfZerosFollowed) {
    set_all();
    pt_camera camera = valid_camera();
    camera.struct_size = offsetof(pt_camera, vertical_fov);
    camera.vertical_fov = camera.shutter_open = -1; // behind the struct that the caller knows
    EXPECT_EQ(pt_set_camera(context(), &camera), PT_OK) << message();
    pt_render render = valid_render();
    render.struct_size = offsetof(pt_render, seed);
    render.estimator = 1000;
    EXPECT_EQ(pt_set_render(context(), &render), PT_OK) << message();
    pt_scene scene = valid_scene();
    scene.struct_size = offsetof(pt_scene, planes);
    scene.planes = reinterpret_cast<const pt_plane *>(&scene);
    EXPECT_EQ(pt_set_scene(context(), &scene), PT_OK) << message();
    pt_accumulate_info info = samples(1);
    info.struct_size = offsetof(pt_accumulate_info, progress);
    info.progress = [](void *, double) -> int32_t { throw std::logic_error("must not be called"); };
    EXPECT_EQ(pt_accumulate(context(), &info), PT_OK) << message();
    info.struct_size = offsetof(pt_accumulate_info, target_error);
    info.progress = nullptr;
    info.target_error = -1;
    EXPECT_EQ(pt_accumulate(context(), &info), PT_OK) << message();
    std::vector<float> pixels(width * height * 3);
    pt_image target = tight_image(pixels);
    target.struct_size = offsetof(pt_image, row_bytes);
    target.row_bytes = 1;
    EXPECT_EQ(pt_readback(context(), &target), PT_OK) << message();
    expect_image(2);
}

TEST_F(ApiTest, WritesStatsIntoOlderAndNewerStructs) {
    set_all();
    accumulate(3);
    pt_stats older{};
    std::memset(&older, 0x55, sizeof older);
    const uint64_t untouched = older.device_bytes;
    older.struct_size = offsetof(pt_stats, device_bytes);
    ASSERT_EQ(pt_get_stats(context(), &older), PT_OK) << message();
    EXPECT_EQ(older.struct_size, offsetof(pt_stats, device_bytes));
    EXPECT_EQ(older.sample_count, 3U);
    EXPECT_EQ(older.rejected_samples, 0U);
    EXPECT_EQ(older.device_bytes, untouched);

    Newer<pt_stats> newer(pt_stats{}, 0x55);
    ASSERT_EQ(pt_get_stats(context(), &newer.known), PT_OK) << message();
    EXPECT_EQ(newer.known.struct_size, sizeof newer);
    EXPECT_EQ(newer.known.sample_count, 3U);
    EXPECT_GT(newer.known.device_bytes, 0U);
    EXPECT_GE(newer.known.submit_count, 1U);
    EXPECT_GT(newer.known.device_seconds, 0.0);
    EXPECT_EQ(newer.unknown, 0x55U);
}

} // namespace

} // namespace api
