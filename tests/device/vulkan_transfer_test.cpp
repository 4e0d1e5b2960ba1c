// Numbers on their way between the host and a device's buffers.
#include "lib/vulkan/buffer.h"
#include "lib/vulkan/device.h"
#include "tests/device/vulkan_fixture.h"

#include "tests/device/recurrence.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <chrono>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace {

using pt::vulkan::Buffer;
using pt::vulkan::BufferUse;
using pt::vulkan::Device;
using VulkanTest = VulkanFixture;

// Both ways of a buffer to the host, on the one device there is.
class VulkanTransferTest : public VulkanTest, public testing::WithParamInterface<bool> {
protected:
    Device &device_under_test() {
        return device_with({.patience = std::chrono::hours{1},
                            .share_memory = GetParam(),
                            .scene_in_constants = false,
                            .invocations = 0,
                            .queue_depth = 1});
    }
};

INSTANTIATE_TEST_SUITE_P(, VulkanTransferTest, testing::Values(true, false),
                         [](const auto &test) { return test.param ? "InPlace" : "Staged"; });

TEST_P(VulkanTransferTest, DownloadReturnsWhatWasUploaded) {
    Device &device = device_under_test();
    // More than two staging buffers hold, and not a multiple of one.
    const std::vector<std::uint32_t> values = counting((33U << 20) / 4 + 3);
    Buffer buffer(device, BufferUse::Storage, values.size() * 4, "test");
    upload(buffer, values);
    EXPECT_TRUE(download(buffer, 0, values.size()) == values);
    const std::size_t first = (15U << 20) / 4 + 1;
    const std::size_t count = (17U << 20) / 4;
    EXPECT_TRUE(std::ranges::equal(download(buffer, first, count), std::span(values).subspan(first, count)));
}

TEST_P(VulkanTransferTest, UploadChangesItsRangeOnly) {
    Buffer buffer(device_under_test(), BufferUse::UniformOrStorage, 1024 * 4, "test");
    std::vector<std::uint32_t> expected = counting(1024);
    upload(buffer, expected);
    const std::array patch = {7U, 8U, 9U};
    upload(buffer, patch, 500);
    std::ranges::copy(patch, expected.begin() + 500);
    EXPECT_EQ(download(buffer, 0, 1024), expected);
    upload(buffer, {}, 0);
    EXPECT_EQ(download(buffer, 0, 1024), expected);
}

} // namespace
