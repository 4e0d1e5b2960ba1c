// The rules for a caller's physical device and queue family, with invented ones.
#include "lib/vulkan/caller_vulkan.h"

#include "tests/support/expected_error.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <string>

namespace {

using Flag = vk::QueueFlagBits;

const std::array families = {
    vk::QueueFamilyProperties{.queueFlags = Flag::eGraphics | Flag::eCompute, .queueCount = 1},
    vk::QueueFamilyProperties{.queueFlags = Flag::eTransfer, .queueCount = 2},
    vk::QueueFamilyProperties{.queueFlags = Flag::eCompute, .queueCount = 8},
};

TEST(CallerVulkan, AQueueFamilyMustCompute) {
    EXPECT_NO_THROW(pt::vulkan::require_compute(families, 0));
    EXPECT_NO_THROW(pt::vulkan::require_compute(families, 2));
    const pt::Error error = error_of([] { pt::vulkan::require_compute(families, 1); });
    EXPECT_EQ(error.code(), PT_ERROR_INVALID_ARGUMENT);
    EXPECT_STREQ(error.what(), "vulkan.queue_family = 1: must have VK_QUEUE_COMPUTE_BIT");
}

TEST(CallerVulkan, APhysicalDeviceMustBeSuitable) {
    pt_device_info device{};
    std::ranges::copy(std::string("Antique"), device.name);
    std::ranges::copy(std::string("Vulkan 1.2 is needed, it has 1.1"), device.reason);
    const pt::Error error = error_of([&] { pt::vulkan::require_suitable(device); });
    EXPECT_EQ(error.code(), PT_ERROR_UNSUPPORTED);
    EXPECT_STREQ(error.what(), "vulkan.physical_device = Antique: does not fit: Vulkan 1.2 is needed, it has 1.1");
    device.suitable = 1;
    EXPECT_NO_THROW(pt::vulkan::require_suitable(device));
}

} // namespace
