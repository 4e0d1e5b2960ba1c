#include "tests/support/context_calls.h"
#include "tests/support/coursework_scene.h"
#include "tests/support/image_target.h"

#include <gtest/gtest.h>
#include <pt/async.h>
#include <pt/pt.h>
#include <pt/stats.h>

#include <atomic>
#include <cstdint>
#include <thread>
#include <vector>

namespace {

constexpr uint32_t width = 32;
constexpr uint32_t height = 16;

using Image = std::vector<float>;

struct Progress {
    std::atomic<bool> stop{false};
    std::atomic<int> calls{0};
    int *unguarded = nullptr;

    static int32_t report(void *user, double) {
        auto *progress = static_cast<Progress *>(user);
        ++progress->calls;
        if (progress->unguarded)
            ++*progress->unguarded;
        return progress->stop ? 1 : 0;
    }
};

pt_context *ready_context(uint64_t seed) {
    pt_create_info create{};
    create.struct_size = sizeof create;
    create.submit_milliseconds = 1;
    pt_context *context = nullptr;
    EXPECT_EQ(pt_create(&create, &context), PT_OK) << pt_last_error(nullptr);
    pt_render render = render_of(width, height, 3);
    render.seed = seed;
    set_coursework(context, render);
    return context;
}

pt_result live(uint64_t seed, uint32_t sample_count, Progress &progress, Image *image = nullptr) {
    pt_context *const context = ready_context(seed);
    const pt_accumulate_info info{sizeof info, sample_count, &Progress::report, &progress, 0, 0, nullptr, 0, 0, {}};
    const pt_result result = pt_accumulate(context, &info);
    EXPECT_GE(result, PT_OK) << pt_last_error(context);
    if (image) {
        image->resize(std::size_t{width} * height * 3);
        const pt_image target = image_target(*image);
        EXPECT_EQ(pt_readback(context, &target), PT_OK) << pt_last_error(context);
    }
    pt_destroy(context);
    return result;
}

TEST(ThreadsTest, ContextsInThreadsGiveTheBitsOfContextsOneByOne) {
    Progress progress;
    Image alone[2];
    Image together[2];
    for (uint64_t seed : {0U, 1U})
        live(seed, 16, progress, &alone[seed]);
    std::thread other([&] { live(1, 16, progress, &together[1]); });
    live(0, 16, progress, &together[0]);
    other.join();
    EXPECT_EQ(together[0], alone[0]);
    EXPECT_EQ(together[1], alone[1]);
    EXPECT_NE(together[0], together[1]);
}

// This thread cancels while another one polls or waits. A cancellation may also come too early or too late.
TEST(ThreadsTest, AnyThreadCancels) {
    pt_context *const context = ready_context(0);
    ASSERT_NE(context, nullptr);
    const pt_accumulate_info info{sizeof info, 1U << 30, nullptr, nullptr, 0, 0, nullptr, 0, 0, {}};
    for (const bool polls : {false, true, false, true}) {
        std::atomic<bool> ended{false};
        pt_result result = PT_OK;
        std::thread renders([&] {
            result = polls ? pt_start(context, &info) : pt_accumulate(context, &info);
            while (result == PT_PENDING)
                result = pt_poll(context, 1'000'000, nullptr);
            ended = true;
        });
        pt_result cancelled = PT_ERROR_INVALID_STATE;
        while (!ended) {
            const pt_result now = pt_cancel(context);
            if (now == PT_OK)
                cancelled = now;
            else
                EXPECT_EQ(now, PT_ERROR_INVALID_STATE);
        }
        renders.join();
        EXPECT_EQ(cancelled, PT_OK);
        EXPECT_EQ(result, PT_CANCELLED) << pt_last_error(context);
        EXPECT_EQ(pt_cancel(context), PT_ERROR_INVALID_STATE);
        EXPECT_STREQ(pt_last_error(context), "no samples are under way: call pt_start first");
    }
    pt_destroy(context);
}

// Two threads break the contract. The second call must be refused without a race.
TEST(ThreadsTest, ASecondThreadIsRefused) {
    pt_context *const context = ready_context(0);
    ASSERT_NE(context, nullptr);
    const pt_camera camera = CourseworkScene::camera();
    Progress progress;
    pt_result result = PT_OK;
    std::thread renders([&] {
        const pt_accumulate_info info{sizeof info, UINT32_MAX, &Progress::report, &progress, 0, 0, nullptr, 0, 0, {}};
        result = pt_accumulate(context, &info);
    });
    while (progress.calls == 0)
        std::this_thread::yield();
    for (int i = 0; i < 1000; ++i) {
        pt_stats stats{};
        stats.struct_size = sizeof stats;
        EXPECT_EQ(pt_get_stats(context, &stats), PT_ERROR_INVALID_STATE);
        EXPECT_STREQ(pt_last_error(context), "this context is in use by another thread");
        EXPECT_EQ(pt_set_camera(context, &camera), PT_ERROR_INVALID_STATE);
        pt_destroy(context);
    }
    progress.stop = true;
    renders.join();
    EXPECT_EQ(result, PT_CANCELLED);
    pt_destroy(context);
}

// Negative control: the sanitizer must report the callback's race.
TEST(ThreadsTest, DISABLED_ARaceInACallback) {
    int unguarded = 0;
    Progress progress;
    progress.unguarded = &unguarded;
    std::thread other([&] { live(1, 64, progress); });
    live(0, 64, progress);
    other.join();
}

} // namespace
