#include "tests/api/api_fixture.h"
#include "tests/api/every_call.h"
#include "tests/support/sized.h"

#include <pt/accuracy.h>
#include <pt/devices.h>
#include <pt/shaders.h>

#include <cstdlib>
#include <cstring>

namespace api {

namespace {

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
    auto info = sized<pt_create_info>();
    info.device = std::getenv("PT_TEST_DEVICE");
    return info;
}

TEST(Api, CreateNeedsAPlaceForTheContext) {
    EXPECT_EQ(pt_create(nullptr, nullptr), PT_ERROR_INVALID_ARGUMENT);
    EXPECT_STREQ(pt_last_error(nullptr), "context = NULL: must not be NULL");
}

TEST(Api, CreateTakesDefaults) {
    EXPECT_EQ(pt_version(), PT_VERSION);
    EXPECT_EQ(create_outcome(nullptr), "created");
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
}

TEST(Api, CreateTellsWhyNoDeviceFits) {
    pt_create_info info = valid_create();
    info.device = "no device has such a name";
    const std::string outcome = create_outcome(&info);
    EXPECT_EQ(outcome.rfind("PT_ERROR_NO_DEVICE: ", 0), 0U) << outcome;
    EXPECT_NE(outcome.find(info.device), std::string::npos) << outcome;
}

TEST(Api, EveryFunctionRefusesANullContext) {
    expect_every_call(outcomes_of_every_call(nullptr), "PT_ERROR_INVALID_ARGUMENT: context = NULL: must not be NULL");
}

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
    refused(pt_get_warning(context(), nullptr), "warning");
    refused(pt_get_accuracy(context(), nullptr, nullptr), "count");
    accumulate(1);
    auto no_data = sized<pt_image>();
    no_data.size_bytes = 1000000;
    refused(pt_readback(context(), &no_data), "image.data");
}

} // namespace

} // namespace api
