// Numbers on their way between the host and a device's buffers, and from kernel to kernel.
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

TEST_P(VulkanTransferTest, ClearZeroesARange) {
    Device &device = device_under_test();
    Buffer buffer(device, BufferUse::Storage, 1024 * 4, "test");
    upload(buffer, counting(1024));
    device.submit([&](const vk::raii::CommandBuffer &commands) { buffer.clear(commands, 100 * 4, 300 * 4); });
    std::vector<std::uint32_t> expected = counting(1024);
    std::fill_n(expected.begin() + 100, 300, 0U);
    EXPECT_EQ(download(buffer, 0, 1024), expected);
}

TEST_P(VulkanTransferTest, KernelsSeeUploadsAndDownloadsSeeKernels) {
    Recurrence recurrence(device_under_test(), 5);
    const std::vector<std::uint32_t> start = counting(recurrence.value_count());
    recurrence.start_with(start);
    recurrence.run(3);
    std::vector<std::uint32_t> expected(start.size());
    std::ranges::transform(start, expected.begin(), [](auto x) { return Recurrence::expected(x, 3); });
    EXPECT_EQ(download(recurrence.values(), 0, start.size()), expected);
    upload(recurrence.values(), start);
    EXPECT_EQ(download(recurrence.values(), 0, start.size()), start);
}

TEST_P(VulkanTransferTest, DispatchesSeeEachOther) {
    Device &device = device_under_test();
    Recurrence recurrence(device, 5);
    recurrence.start_with(zeros(recurrence.value_count()));
    recurrence.run(2); // in another submission
    device.submit([&](const vk::raii::CommandBuffer &commands) {
        recurrence.record(commands, 3);
        pt::vulkan::barrier_between_commands(commands);
        recurrence.record(commands, 4);
    });
    const std::uint32_t expected = Recurrence::expected(Recurrence::expected(Recurrence::expected(0, 2), 3), 4);
    EXPECT_EQ(download(recurrence.values(), 0, recurrence.value_count()),
              std::vector<std::uint32_t>(recurrence.value_count(), expected));
}

} // namespace
