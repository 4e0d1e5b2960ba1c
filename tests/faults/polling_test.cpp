#include "tests/faults/vulkan_calls.h"
#include "tests/support/context_calls.h"
#include "tests/support/context_fixture.h"
#include "tests/support/shared_context.h"
#include "tests/support/sized.h"

#include <pt/async.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <chrono>
#include <cstdint>
#include <iterator>
#include <vector>

namespace {

using namespace faults;

struct Way {
    bool gpu;
    uint32_t device_count;
    uint32_t submit_milliseconds;
    double target_error;
    bool by_tile;
};

constexpr Way ways[] = {{false, 2, 1, 0, false}, {false, 1, 50, 0.05, false}, {false, 1, 50, 0, true},
                        {true, 1, 1, 0, false},  {true, 2, 50, 0.05, false},  {true, 1, 50, 0, true}};

constexpr uint32_t polled_size = 48;
constexpr double places[][3] = {{0, 0, 1}, {0, -1, 1}, {0, 6, 1}, {-2, -2, -12}, {-2, -2, -10}};

long pipelines() {
    const auto live = live_objects();
    const auto found = live.find("vkCreateComputePipelines");
    return found == live.end() ? 0 : found->second;
}

// Other places of the camera need other kernels: within the ball, below the floor, or without known sides.
void expect_nothing_built_by_polls(const Way &way) {
    pose_as_gpu(way.gpu);
    auto info = sized<pt_create_info>();
    info.submit_milliseconds = way.submit_milliseconds;
    pt_context *made = nullptr;
    ASSERT_EQ(create_shared(way.device_count, info, &made, way.gpu, 16), PT_OK) << pt_last_error(nullptr);
    const Context context(made);
    set_coursework(made, render_of(polled_size, polled_size, 3));
    ASSERT_EQ(pt_prepare(made), PT_OK) << pt_last_error(made);
    const std::vector<uint32_t> tiles((polled_size / 8) * (polled_size / 8), 40);
    for (const auto &place : places) {
        pt_camera camera = CourseworkScene::camera();
        std::copy(std::begin(place), std::end(place), camera.position);
        ASSERT_EQ(pt_set_camera(made, &camera), PT_OK) << pt_last_error(made);
        auto samples = sized<pt_accumulate_info>();
        samples.sample_count = way.by_tile ? 40 : 1U << 20;
        samples.stopping.target_error = way.target_error;
        samples.tile_samples = way.by_tile ? tiles.data() : nullptr;
        samples.tile_count = way.by_tile ? static_cast<uint32_t>(tiles.size()) : 0;
        pt_result result = pt_start(made, &samples);
        const long built = pipelines();
        for (int i = 0; result == PT_PENDING && i < 60; ++i) {
            pass_time(std::chrono::milliseconds{1});
            result = pt_poll(made, 0, nullptr);
            ASSERT_EQ(pipelines(), built) << "poll " << i << " at " << place[1] << ", " << place[2];
        }
        if (result == PT_PENDING) {
            EXPECT_EQ(pt_cancel(made), PT_OK);
            result = pt_poll(made, UINT64_MAX, nullptr);
        }
        EXPECT_GE(result, PT_OK) << pt_last_error(made);
        EXPECT_EQ(pipelines(), built);
    }
}

TEST(PollingTest, PollsBuildNothing) {
    for (const Way &way : ways) {
        SCOPED_TRACE(testing::Message() << (way.gpu ? "gpu" : "cpu") << ", " << way.device_count << " devices, "
                                        << way.submit_milliseconds << " ms, target " << way.target_error
                                        << (way.by_tile ? ", by tile" : ""));
        expect_nothing_built_by_polls(way);
    }
    pose_as_gpu(false);
}

} // namespace
