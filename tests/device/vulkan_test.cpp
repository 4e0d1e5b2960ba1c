// How a device is waited for, and that the validation layer is heard.
#include "lib/vulkan/device.h"
#include "tests/device/vulkan_fixture.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <chrono>
#include <cstdint>
#include <string>

namespace {

using VulkanTest = VulkanFixture;

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
