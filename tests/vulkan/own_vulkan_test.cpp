#include "tests/support/context_calls.h"
#include "tests/support/context_fixture.h"
#include "tests/support/coursework_scene.h"
#include "tests/support/render_image.h"
#include "tests/support/scene_of.h"
#include "tests/support/shared_context.h"
#include "tests/support/sized.h"
#include "tests/vulkan/caller_vulkan.h"

#include <pt/async.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <cstring>
#include <functional>
#include <mutex>
#include <thread>

namespace {

constexpr std::uint32_t own_width = 60;
constexpr std::uint32_t own_height = 33;
constexpr std::uint32_t samples = 9;

std::vector<float> render(pt_context *context, std::uint64_t seed, std::uint32_t submit_count = 1) {
    const CourseworkScene coursework;
    pt_render settings = render_of(own_width, own_height, 3);
    settings.seed = seed;
    std::vector<float> image;
    for (std::uint32_t i = 0; i < submit_count; ++i)
        image = render_image(context, coursework.scene(), CourseworkScene::camera(), settings, samples);
    return image;
}

struct QueueMutex {
    std::mutex mutex;
    std::uint64_t locks = 0;
    std::uint64_t unlocks = 0;

    static void lock(void *user) {
        auto *self = static_cast<QueueMutex *>(user);
        self->mutex.lock();
        ++self->locks;
    }
    static void unlock(void *user) {
        auto *self = static_cast<QueueMutex *>(user);
        ++self->unlocks;
        self->mutex.unlock();
    }

    void guard(pt_vulkan &vulkan) {
        vulkan.lock_queue = &QueueMutex::lock;
        vulkan.unlock_queue = &QueueMutex::unlock;
        vulkan.queue_user = this;
    }
};

class OwnVulkanTest : public CallerVulkanFixture {
protected:
    const CallersOwnVulkan &caller() const { return *caller_; }

    static pt_create_info info_of(const pt_vulkan &vulkan) {
        auto info = sized<pt_create_info>();
        info.vulkan = &vulkan;
        return info;
    }

    static Context context_on(const pt_vulkan &vulkan) {
        const pt_create_info info = info_of(vulkan);
        pt_context *created = nullptr;
        EXPECT_EQ(pt_create(&info, &created), PT_OK) << pt_last_error(nullptr);
        return Context(created);
    }

    static std::string refusal(const pt_create_info &info) {
        pt_context *created = nullptr;
        const pt_result result = pt_create(&info, &created);
        EXPECT_EQ(created, nullptr);
        pt_destroy(created);
        return std::string(pt_result_name(result)) + ": " + pt_last_error(nullptr);
    }
    static std::string refusal(const pt_vulkan &vulkan) { return refusal(info_of(vulkan)); }

    void expect_usable() const {
        const vk::raii::Device &device = caller().device();
        const vk::raii::CommandPool pool = device.createCommandPool({.queueFamilyIndex = caller().family()});
        const std::vector<vk::raii::CommandBuffer> commands =
            device.allocateCommandBuffers({.commandPool = *pool, .commandBufferCount = 1});
        const vk::raii::Event event = device.createEvent({});
        commands[0].begin({});
        commands[0].setEvent(*event, vk::PipelineStageFlagBits::eComputeShader);
        commands[0].end();
        const vk::CommandBuffer work = *commands[0];
        caller().queue().submit(vk::SubmitInfo{.commandBufferCount = 1, .pCommandBuffers = &work});
        caller().queue().waitIdle();
        EXPECT_EQ(event.getStatus(), vk::Result::eEventSet);
    }
};

TEST_F(OwnVulkanTest, GivesTheBitsOfADeviceOfItsOwn) {
    const Context borrowing = context_on(caller().handles());
    auto own = sized<pt_create_info>();
    own.device = std::getenv("PT_TEST_DEVICE");
    pt_context *created = nullptr;
    ASSERT_EQ(pt_create(&own, &created), PT_OK) << pt_last_error(nullptr);
    const Context alone(created);
    const std::vector<float> image = render(borrowing.get(), 0);
    EXPECT_EQ(image, render(alone.get(), 0));
    EXPECT_NE(image, render(alone.get(), 1)) << "another image must show";
    pt_device_info devices[2];
    ASSERT_EQ(pt_get_context_device(borrowing.get(), &devices[0]), PT_OK);
    ASSERT_EQ(pt_get_context_device(alone.get(), &devices[1]), PT_OK);
    EXPECT_EQ(std::memcmp(&devices[0], &devices[1], sizeof devices[0]), 0);
}

TEST_F(OwnVulkanTest, ContextsInTwoThreadsShareTheQueue) {
    constexpr std::uint32_t rounds = 5;
    QueueMutex mutex;
    pt_vulkan vulkan = caller().handles();
    mutex.guard(vulkan);
    std::vector<float> together[2];
    std::vector<float> alone[2];
    const auto render_on_its_own = [&](std::uint32_t i) { together[i] = render(context_on(vulkan).get(), i, rounds); };
    std::thread first(render_on_its_own, 0);
    std::thread second(render_on_its_own, 1);
    first.join();
    second.join();
    for (const std::uint32_t i : {0U, 1U})
        alone[i] = render(context_on(vulkan).get(), i);
    EXPECT_EQ(together[0], alone[0]);
    EXPECT_EQ(together[1], alone[1]);
    EXPECT_NE(together[0], together[1]);
    EXPECT_EQ(mutex.locks, mutex.unlocks);
    EXPECT_GE(mutex.locks, 2 * rounds + 2);
}

TEST_F(OwnVulkanTest, TheQueueIsFreeWhileTheContextCallsBack) {
    struct Observer {
        std::function<void()> use_queue;
        QueueMutex mutex{};
        int calls = 0;

        static std::int32_t progress(void *user, double) {
            auto *self = static_cast<Observer *>(user);
            ++self->calls;
            if (self->mutex.locks != self->mutex.unlocks)
                return 1;
            const std::lock_guard held(self->mutex.mutex);
            self->use_queue();
            return 0;
        }
    } observer{[this] { expect_usable(); }};
    pt_vulkan vulkan = caller().handles();
    observer.mutex.guard(vulkan);
    const Context context = context_on(vulkan);
    const std::vector<float> image = render(context.get(), 0);
    const std::uint64_t locks = observer.mutex.locks;
    const pt_accumulate_info more = accumulate_info(samples, 0.0, &Observer::progress, &observer);
    EXPECT_EQ(pt_accumulate(context.get(), &more), PT_OK);
    const pt_stats stats = stats_of(context.get());
    EXPECT_GT(observer.calls, 0);
    EXPECT_GE(observer.mutex.locks, locks + static_cast<std::uint64_t>(observer.calls));
    EXPECT_GE(observer.mutex.locks, stats.submit_count);
    EXPECT_EQ(observer.mutex.locks, observer.mutex.unlocks);
}

// pt_prepare submits an empty dispatch, because some drivers compile kernels only at the first dispatch.
TEST_F(OwnVulkanTest, PreparingIsOneSubmission) {
    QueueMutex mutex;
    pt_vulkan vulkan = caller().handles();
    mutex.guard(vulkan);
    const Context context = context_on(vulkan);
    render(context.get(), 0);
    const std::uint64_t before = mutex.locks;
    ASSERT_EQ(pt_prepare(context.get()), PT_OK) << pt_last_error(context.get());
    EXPECT_EQ(mutex.locks, before + 1);
}

// A GPU estimates errors within the submissions of samples.
TEST_F(OwnVulkanTest, LooksAtATargetAreNoSubmissions) {
    QueueMutex mutex;
    pt_vulkan vulkan = caller().handles();
    mutex.guard(vulkan);
    pt_create_info info = info_of(vulkan);
    info.submit_milliseconds = 1000;
    pt_context *created = nullptr;
    ASSERT_EQ(create_shared(1, info, &created, true), PT_OK) << pt_last_error(nullptr);
    const Context context(created);
    const CourseworkScene coursework;
    render_image(created, coursework.scene(), CourseworkScene::camera(), render_of(own_width, own_height, 3), samples);
    const std::uint64_t submissions = stats_of(created).submit_count;
    const std::uint64_t locks = mutex.locks;
    const pt_accumulate_info to_a_target = accumulate_info(4096, 0.1);
    ASSERT_EQ(pt_accumulate(created, &to_a_target), PT_TARGET_REACHED) << pt_last_error(created);
    const std::uint64_t reached = mutex.locks;
    EXPECT_GT(stats_of(created).sample_count, 20U) << "several looks";
    EXPECT_EQ(reached - locks, stats_of(created).submit_count - submissions);
    EXPECT_EQ(mutex.locks, reached) << "it is known";
    const pt_accumulate_info eight = accumulate_info(8);
    ASSERT_EQ(pt_accumulate(created, &eight), PT_OK) << pt_last_error(created);
    const std::uint64_t before = mutex.locks;
    EXPECT_GT(error_of(created).relative_rmse, 0.0);
    EXPECT_EQ(mutex.locks, before + 1);
}

TEST_F(OwnVulkanTest, HandlesThatBreakARuleAreRefused) {
    auto vulkan = sized<pt_vulkan>();
    vulkan.unlock_queue = &QueueMutex::unlock;
    EXPECT_EQ(refusal(vulkan), "PT_ERROR_INVALID_ARGUMENT: vulkan.instance = NULL: must not be NULL\n"
                               "vulkan.physical_device = NULL: must not be NULL\n"
                               "vulkan.device = NULL: must not be NULL\n"
                               "vulkan.queue = NULL: must not be NULL\n"
                               "vulkan.lock_queue = NULL: must not be NULL with unlock_queue");
    vulkan = caller().handles();
    vulkan.lock_queue = &QueueMutex::lock;
    EXPECT_EQ(refusal(vulkan),
              "PT_ERROR_INVALID_ARGUMENT: vulkan.unlock_queue = NULL: must not be NULL with lock_queue");
    vulkan = caller().handles();
    vulkan.queue_family = static_cast<std::uint32_t>(caller().physical_device().getQueueFamilyProperties().size());
    const std::string count = std::to_string(vulkan.queue_family);
    EXPECT_EQ(refusal(vulkan), "PT_ERROR_INVALID_ARGUMENT: vulkan.queue_family = " + count + ": must be < " + count +
                                   ", the number of families of vulkan.physical_device");
    vulkan = caller().handles();
    vulkan.struct_size = 0;
    EXPECT_EQ(refusal(vulkan), "PT_ERROR_INVALID_ARGUMENT: vulkan.struct_size = 0: must be the size of the struct, "
                               "which holds this field");
}

TEST_F(OwnVulkanTest, ExcludesWhatIsTheLibrarysOwn) {
    const pt_vulkan vulkan = caller().handles();
    pt_create_info info = info_of(vulkan);
    info.flags = PT_CREATE_VALIDATION;
    info.device = "all";
    EXPECT_EQ(refusal(info), "PT_ERROR_INVALID_ARGUMENT: create.flags = 1: must not have PT_CREATE_VALIDATION with "
                             "vulkan, whose instance has its "
                             "own layers\n"
                             "create.device = \"all\": must be NULL with vulkan, which has one");
}

TEST_F(OwnVulkanTest, ThePhysicalDeviceMustBeTheInstances) {
    const CallersOwnVulkan other(messages_);
    pt_vulkan vulkan = caller().handles();
    vulkan.physical_device = other.handles().physical_device;
    const std::string message = refusal(vulkan);
    EXPECT_EQ(message.rfind("PT_ERROR_INVALID_ARGUMENT: vulkan.physical_device = 0x", 0), 0U) << message;
    EXPECT_NE(message.find(": must be one of vulkan.instance"), std::string::npos) << message;
}

TEST_F(OwnVulkanTest, TheInstanceMustHaveVersion1_2) {
    for (const std::uint32_t version : {VK_API_VERSION_1_0, VK_API_VERSION_1_1}) {
        const CallersOwnVulkan older(messages_, version);
        if (older.device().getProcAddr("vkGetSemaphoreCounterValue"))
            GTEST_SKIP() << "this driver tells instances of no version";
        const std::string message = refusal(older.handles());
        EXPECT_EQ(message.rfind("PT_ERROR_INVALID_ARGUMENT: vulkan.instance = 0x", 0), 0U) << message;
        EXPECT_NE(message.find(": must have been created with VkApplicationInfo.apiVersion >= VK_API_VERSION_1_2"),
                  std::string::npos)
            << message;
    }
    const CallersOwnVulkan newer(messages_, VK_API_VERSION_1_3);
    EXPECT_TRUE(context_on(newer.handles()));
}

// Negative control.
TEST_F(OwnVulkanTest, TheLayerReportsLeaks) {
    if (!CallersOwnVulkan::validation())
        GTEST_SKIP() << "the layer is off";
    caller().device().createEvent({}).release();
    caller_.reset();
    const std::vector<std::string> lines = messages_.take();
    EXPECT_TRUE(std::ranges::any_of(lines, [](const std::string &line) {
        return line.find("VkEvent") != std::string::npos && line.find("has not been destroyed") != std::string::npos;
    }));
}

} // namespace
