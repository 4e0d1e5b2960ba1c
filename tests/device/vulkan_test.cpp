// What is known of a device and its driver, how it is waited for, and that the validation layer is heard.
#include "lib/vulkan/device.h"
#include "lib/vulkan/device_choice.h"
#include "tests/device/vulkan_fixture.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <chrono>
#include <cstdint>
#include <string>

namespace {

using VulkanTest = VulkanFixture;

TEST_F(VulkanTest, DescribesTheDevice) {
    const pt_device_info &info = device().info();
    EXPECT_EQ(info.suitable, 1U);
    EXPECT_STREQ(info.reason, "");
    EXPECT_STRNE(info.name, "");
    EXPECT_STRNE(info.driver, "");
    EXPECT_GT(info.memory_bytes, 0U);
    EXPECT_TRUE(std::ranges::any_of(info.uuid, [](std::uint8_t byte) { return byte != 0; }));
    // What Vulkan guarantees.
    EXPECT_GE(device().limits().max_storage_buffer_range, 1U << 27);
    EXPECT_GE(device().limits().max_allocation_bytes, 1U << 30);
    EXPECT_GE(device().limits().max_workgroup_count, 65535U);
    EXPECT_GE(device().limits().max_uniform_range, 16384U);
    EXPECT_LE(device().limits().max_uniform_range, 65536U);
    EXPECT_EQ(device().limits().max_uniform_range % 256, 0U);
}

TEST_F(VulkanTest, GpusAreWaitedForInBoundedTime) {
    pt_device_info info{};
    for (const std::uint32_t gpu :
         {PT_DEVICE_DISCRETE_GPU, PT_DEVICE_INTEGRATED_GPU, PT_DEVICE_VIRTUAL_GPU, PT_DEVICE_OTHER}) {
        info.kind = gpu;
        EXPECT_EQ(pt::vulkan::default_policy(info).patience, std::chrono::seconds{10});
        EXPECT_FALSE(pt::vulkan::default_policy(info).scene_in_constants);
    }
    info.kind = PT_DEVICE_CPU;
    EXPECT_EQ(pt::vulkan::default_policy(info).patience, std::chrono::nanoseconds::max());
    EXPECT_TRUE(pt::vulkan::default_policy(info).scene_in_constants);
}

// The negative control of every test here.
TEST_F(VulkanTest, TheLayersMessagesReachTheLog) {
    if (!validation())
        GTEST_SKIP() << "the layer is off";
    EXPECT_TRUE(messages_.empty());
    const vk::BufferCreateInfo empty{.size = 0, .usage = vk::BufferUsageFlagBits::eStorageBuffer};
    { const vk::raii::Buffer mistake(device().handle(), empty); }
    const auto reported = [](const std::string &line) {
        return line.find("VUID-VkBufferCreateInfo-size-00912") != std::string::npos;
    };
    EXPECT_TRUE(std::ranges::any_of(messages_, reported));
    messages_.clear();
}

} // namespace
