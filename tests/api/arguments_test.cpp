#include "lib/kernel/accuracy.h"
#include "tests/api/api_fixture.h"
#include "tests/api/every_call.h"
#include "tests/support/sized.h"

#include <pt/accuracy.h>
#include <pt/devices.h>

#include <algorithm>
#include <cstring>

namespace api {

namespace {

// `get` writes at most *count rows, and sets *count to their number. Returns all rows.
template <typename Row, typename Get>
std::vector<Row> checked_rows(const Get &get) {
    uint32_t available = 0;
    EXPECT_EQ(get(nullptr, &available), PT_OK);
    EXPECT_GT(available, 0U);
    std::vector<Row> all(available);
    EXPECT_EQ(get(all.data(), &available), PT_OK);
    for (const uint32_t room : {0U, available / 2, available, available + 1}) {
        std::vector<Row> rows(available + 2);
        std::memset(static_cast<void *>(rows.data()), 0x55, rows.size() * sizeof(Row));
        const Row untouched = rows.back();
        uint32_t count = room;
        EXPECT_EQ(get(rows.data(), &count), PT_OK);
        EXPECT_EQ(count, std::min(room, available));
        for (std::size_t i = 0; i < rows.size(); ++i)
            EXPECT_EQ(std::memcmp(&rows[i], i < count ? &all[i] : &untouched, sizeof untouched), 0)
                << room << ", " << i;
    }
    return all;
}

TEST(Api, DevicesSayWhyTheyDoNotFit) {
    const auto devices = checked_rows<pt_device_info>(&pt_get_devices);
    for (const pt_device_info &device : devices) {
        EXPECT_LE(device.kind, uint32_t{PT_DEVICE_CPU});
        EXPECT_NE(device.name[0], '\0');
        EXPECT_EQ(device.suitable == 1, device.reason[0] == '\0');
    }
}

TEST_F(ApiTest, AccuracyNeedsNoScene) {
    const auto rows = checked_rows<pt_function_accuracy>(
        [&](pt_function_accuracy *to, uint32_t *count) { return pt_get_accuracy(context(), to, count); });
    ASSERT_EQ(rows.size(), pt::elementary_functions().size());
    for (std::size_t i = 0; i < rows.size(); ++i) {
        EXPECT_STREQ(rows[i].name, pt::elementary_functions()[i].name) << "a name too long is cut";
        EXPECT_GE(rows[i].worst_error, 0.0) << rows[i].name;
        EXPECT_LE(rows[i].worst_error, rows[i].bound) << rows[i].name;
    }
}

TEST(Api, TheVersionIsThatOfTheHeader) {
    EXPECT_EQ(pt_version(), PT_VERSION);
}

TEST(Api, CreateRefusesWhatItDoesNotKnow) {
    auto info = sized<pt_create_info>();
    info.flags = 6;
    info.submit_milliseconds = 1001;
    info.reserved = 1;
    pt_context *context = reinterpret_cast<pt_context *>(&context);
    EXPECT_EQ(pt_create(&info, &context), PT_ERROR_INVALID_ARGUMENT);
    EXPECT_EQ(context, nullptr);
    EXPECT_STREQ(pt_last_error(nullptr), "create.flags = 6: must be a combination of PT_CREATE_* of pt.h\n"
                                         "create.submit_milliseconds = 1001: must be <= 1000\n"
                                         "create.reserved = 1: must be 0");
}

TEST(Api, EveryFunctionRefusesANullContext) {
    expect_every_call(outcomes_of_every_call(nullptr), "PT_ERROR_INVALID_ARGUMENT: context = NULL: must not be NULL");
    EXPECT_EQ(pt_poll(nullptr, 0, nullptr), PT_ERROR_INVALID_ARGUMENT);
    EXPECT_EQ(pt_cancel(nullptr), PT_ERROR_INVALID_ARGUMENT);
}

TEST_F(ApiTest, RefusesNullPointers) {
    set_all();
    const auto refused = [&](pt_result result, const std::string &name, const pt_context *on) {
        EXPECT_EQ(result, PT_ERROR_INVALID_ARGUMENT);
        EXPECT_EQ(pt_last_error(on), name + " = NULL: must not be NULL");
    };
    refused(pt_create(nullptr, nullptr), "context", nullptr);
    refused(pt_get_devices(nullptr, nullptr), "count", nullptr);
    refused(pt_set_scene(context(), nullptr), "scene", context());
    refused(pt_set_camera(context(), nullptr), "camera", context());
    refused(pt_set_render(context(), nullptr), "render", context());
    refused(pt_accumulate(context(), nullptr), "accumulate", context());
    refused(pt_readback(context(), nullptr), "image", context());
    refused(pt_get_context_device(context(), nullptr), "device", context());
    refused(pt_get_stats(context(), nullptr), "stats", context());
    refused(pt_get_warning(context(), nullptr), "warning", context());
    refused(pt_get_accuracy(context(), nullptr, nullptr), "count", context());
    accumulate(1);
    auto no_data = sized<pt_image>();
    no_data.size_bytes = 1000000;
    refused(pt_readback(context(), &no_data), "image.data", context());
}

} // namespace

} // namespace api
