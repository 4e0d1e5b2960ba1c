#include "lib/base/error.h"
#include "lib/render/render_device.h"
#include "lib/scene/checked_scene.h"
#include "lib/view/camera_rules.h"
#include "lib/view/view.h"
#include "lib/vulkan/buffer.h"
#include "lib/vulkan/compute_pipeline.h"
#include "lib/vulkan/device_choice.h"
#include "recurrence.spv.h"
#include "tests/support/checked_scene_of.h"
#include "tests/support/coursework_scene.h"
#include "tests/support/expected_error.h"
#include "tests/vulkan/caller_vulkan.h"
#include "tests/vulkan/held_work.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <chrono>
#include <cstring>
#include <memory>
#include <optional>

namespace {

using pt::vulkan::Buffer;
using pt::vulkan::BufferUse;
using pt::vulkan::CallerVulkan;
using pt::vulkan::ComputePipeline;
using pt::vulkan::DescriptorSet;
using pt::vulkan::Device;
using pt::vulkan::Instance;

class QueueSpy {
public:
    explicit QueueSpy(const vk::raii::Device &device) {
        counts = {};
        using Functions = std::remove_cvref_t<decltype(*device.getDispatcher())>;
        auto *functions = const_cast<Functions *>(device.getDispatcher());
        real_submit = functions->vkQueueSubmit;
        functions->vkQueueSubmit = &submit;
        functions->vkQueueWaitIdle = [](VkQueue) { return wait(); };
        functions->vkDeviceWaitIdle = [](VkDevice) { return wait(); };
    }

    static void lock(void *) {
        ++counts.locks;
        counts.held = true;
    }
    static void unlock(void *) { counts.held = false; }

    struct Counts {
        int locks, submissions, submissions_without_lock, waits_for_all;
        bool held;
        VkResult failure; // If this is not VK_SUCCESS, nothing is submitted.
    };
    static inline Counts counts{};

private:
    static VkResult submit(VkQueue queue, std::uint32_t count, const VkSubmitInfo *infos, VkFence fence) {
        ++counts.submissions;
        counts.submissions_without_lock += counts.held ? 0 : 1;
        return counts.failure == VK_SUCCESS ? real_submit(queue, count, infos, fence) : counts.failure;
    }
    static VkResult wait() {
        ++counts.waits_for_all;
        return VK_SUCCESS;
    }
    static inline PFN_vkQueueSubmit real_submit = nullptr;
};

void clear(Device &device, const Buffer &buffer) {
    device.submit([&](const vk::raii::CommandBuffer &commands) { buffer.clear(commands, 0, buffer.size()); });
}

class BorrowedDeviceTest : public CallerVulkanFixture {
protected:
    CallerVulkan handles(bool with_lock) const {
        pt_vulkan vulkan = caller_->handles();
        vulkan.lock_queue = with_lock ? &QueueSpy::lock : nullptr;
        vulkan.unlock_queue = with_lock ? &QueueSpy::unlock : nullptr;
        return pt::vulkan::validated_vulkan(vulkan);
    }
};

TEST_F(BorrowedDeviceTest, EverySubmissionHoldsTheQueue) {
    const CallerVulkan handles = this->handles(true);
    Instance instance(pt::Log{}, handles.instance);
    const vk::raii::PhysicalDevice physical = validated_physical_device(instance.handle(), handles);
    pt::RenderDevice device(instance, physical, pt::vulkan::default_policy(pt::vulkan::describe(physical)),
                            pt::embedded_code(), 0.05, &handles);
    const QueueSpy spy(device.device().handle());
    const pt::RenderSettings settings = pt::validated_render(render_of(20, 10, 2));
    device.set_film(device.make_film(settings));
    const CourseworkScene coursework;
    const pt::PreparedScene scene(pt::owned_scene(checked_scene_of(coursework.scene())));
    const pt::Camera camera = pt::validated_camera(CourseworkScene::camera());
    device.prepare(std::make_shared<const pt::View>(pt::view_of(scene, camera, settings)), settings);
    constexpr std::array<std::uint32_t, 6> tiles = {0, 1, 2, 3, 4, 5};
    device.start({tiles, {}, {0, 4}, true});
    device.finish();
    EXPECT_EQ(device.film().rejected_samples(), 0U);
    device.discard_samples();
    std::array<std::byte, 64> words{};
    Buffer buffer(device.device(), BufferUse::Storage, words.size(), "test");
    clear(device.device(), buffer);
    buffer.upload(words, 0);
    buffer.download(words, 0);
    EXPECT_GE(QueueSpy::counts.submissions, 2);
    EXPECT_EQ(QueueSpy::counts.submissions_without_lock, 0);
    EXPECT_EQ(QueueSpy::counts.locks, QueueSpy::counts.submissions);
    EXPECT_FALSE(QueueSpy::counts.held);
    EXPECT_EQ(QueueSpy::counts.waits_for_all, 0);
}

TEST_F(BorrowedDeviceTest, ASubmissionThatLosesTheDeviceLetsGoOfTheQueue) {
    const CallerVulkan handles = this->handles(true);
    Instance instance(pt::Log{}, handles.instance);
    const vk::raii::PhysicalDevice physical = validated_physical_device(instance.handle(), handles);
    Device device(instance, physical, pt::vulkan::default_policy(pt::vulkan::describe(physical)), &handles);
    const QueueSpy spy(device.handle());
    Buffer buffer(device, BufferUse::Storage, 64, "test");
    QueueSpy::counts.failure = VK_ERROR_DEVICE_LOST;
    EXPECT_EQ(error_of([&] { clear(device, buffer); }).code(), PT_ERROR_DEVICE_LOST);
    EXPECT_EQ(QueueSpy::counts.locks, 1);
    EXPECT_FALSE(QueueSpy::counts.held);
    QueueSpy::counts.failure = VK_SUCCESS;
    EXPECT_EQ(error_of([&] { clear(device, buffer); }).code(), PT_ERROR_DEVICE_LOST) << "for good";
    EXPECT_EQ(QueueSpy::counts.submissions, 1);
}

#ifndef __SANITIZE_ADDRESS__ // The test leaks memory on purpose.
// The library stops waiting for the work, but the work still uses its buffers and the device.
TEST_F(BorrowedDeviceTest, ADeviceThatHangsKeepsWhatItsWorkUses) {
    const CallerVulkan handles = this->handles(false);
    std::optional<HeldWork> gate(caller_->device());
    {
        Instance instance(pt::Log{}, handles.instance);
        const vk::raii::PhysicalDevice physical = validated_physical_device(instance.handle(), handles);
        Device device(instance, physical,
                      {.patience = std::chrono::nanoseconds{0},
                       .share_memory = true,
                       .scene_in_constants = false,
                       .invocations = 0,
                       .queue_depth = 1},
                      &handles);
        const ComputePipeline pipeline(
            device, recurrence_spirv(),
            std::array<pt::vulkan::Binding, 2>{{{0, vk::DescriptorType::eUniformBuffer}, {1}}}, 4,
            std::array{1664525U, 1013904223U});
        constexpr std::uint32_t groups = 4;
        Buffer offset(device, BufferUse::UniformOrStorage, 1024, "offset");
        Buffer values(device, BufferUse::Storage, groups * 64 * 4, "values");
        const DescriptorSet set = pipeline.bind(std::array<pt::vulkan::BufferRange, 2>{offset, values});
        const std::uint32_t steps = 1;
        const pt::Error loss = error_of([&] {
            device.submit([&](const vk::raii::CommandBuffer &commands) {
                gate->record(commands);
                pipeline.dispatch(commands, set, std::as_bytes(std::span(&steps, 1)), groups);
            });
        });
        EXPECT_EQ(loss.code(), PT_ERROR_DEVICE_LOST);
        EXPECT_TRUE(device.hangs());
    }
    gate.reset(); // ends the work, unlike a hung device
    for (const std::string &line : messages_.take())
        ADD_FAILURE() << "destroyed too early: " << line;
    caller_.reset();
    const std::vector<std::string> left = messages_.take();
    if (!CallersOwnVulkan::validation())
        return;
    for (const char *kind :
         {"VkBuffer", "VkDeviceMemory", "VkPipeline", "VkDescriptorPool", "VkFence", "VkCommandPool"})
        EXPECT_TRUE(std::ranges::any_of(left, [&](const std::string &line) {
            return line.find(std::string(kind) + " ") != std::string::npos &&
                   line.find("has not been destroyed") != std::string::npos;
        })) << kind;
}
#endif

} // namespace
