#include "lib/vulkan/buffer.h"
#include "lib/vulkan/compute_pipeline.h"
#include "lib/vulkan/device.h"
#include "tests/vulkan/device_fixture.h"

#include "lib/base/error.h"
#include "tests/support/expected_error.h"
#include "tests/vulkan/recurrence.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <chrono>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include <sys/resource.h>

namespace {

using pt::vulkan::Buffer;
using pt::vulkan::BufferUse;
using pt::vulkan::ComputePipeline;
using pt::vulkan::DescriptorSet;
using pt::vulkan::Device;
using VulkanTest = VulkanFixture;

TEST_F(VulkanTest, CountsWhatTransfersTake) {
    pt::vulkan::DevicePolicy policy = pt::vulkan::default_policy(device().info());
    policy.share_memory = false;
    device_with(policy);
    const std::uint64_t before = device().allocated_bytes();
    {
        Buffer buffer(device(), BufferUse::Storage, 4096, "test");
        const std::array<std::byte, 4> word{};
        buffer.upload(word, 0);
        buffer.upload(word, 4);
        EXPECT_EQ(device().allocated_bytes(), before + 2 * 4096) << "the buffer, and one for its transfers";
    }
    EXPECT_EQ(device().allocated_bytes(), before);
}

TEST_F(VulkanTest, ADynamicOffsetChoosesThePartOfAStreamedBuffer) {
    constexpr pt::vulkan::Binding bindings[] = {{0, vk::DescriptorType::eUniformBufferDynamic}, {1}};
    constexpr std::array keep_the_sum = {1U, 0U};
    const ComputePipeline pipeline(device(), recurrence_spirv(), bindings, 4, keep_the_sum);
    const std::uint32_t range = device().limits().max_uniform_range;
    Buffer offsets(device(), BufferUse::Streamed, std::uint64_t{3} * range, "offsets");
    Buffer values(device(), BufferUse::Storage, 64 * 4, "values");
    const DescriptorSet set = pipeline.bind(std::array<pt::vulkan::BufferRange, 2>{offsets, values});
    const std::uint32_t steps = 1;
    for (const std::uint32_t round : {0U, 1U}) {
        std::uint32_t expected = 0;
        for (std::uint32_t part = 0; part < 3; ++part) {
            const std::array words = {1000 * round + 10 * part + 1, 0U, 0U, 0U};
            offsets.upload(std::as_bytes(std::span(words)), std::uint64_t{part} * range);
            expected += part == 1 ? 0 : words[0];
        }
        clear_all(device(), values);
        device().submit([&](const vk::raii::CommandBuffer &commands) {
            for (const std::uint32_t part : {2U, 0U}) {
                pipeline.dispatch(commands, set, std::as_bytes(std::span(&steps, 1)), 1, std::array{part * range});
                pt::vulkan::barrier_between_commands(commands);
            }
        });
        EXPECT_EQ(download(values, 0, 64), std::vector<std::uint32_t>(64, expected));
    }
}

TEST_F(VulkanTest, ABufferLargerThanAnAllocationMayBeIsRefused) {
    const std::uint64_t before = device().allocated_bytes();
    const std::uint64_t bytes = device().limits().max_allocation_bytes + 4;
    const pt::Error error = error_of([&] { Buffer(device(), BufferUse::Storage, bytes, "film"); });
    EXPECT_EQ(error.code(), PT_ERROR_OUT_OF_DEVICE_MEMORY);
    EXPECT_TRUE(names(error, std::to_string(bytes)) && names(error, "film")) << error.what();
    EXPECT_EQ(device().allocated_bytes(), before);
}

#ifndef __SANITIZE_ADDRESS__ // The sanitizer's own memory exceeds any limit.
TEST_F(VulkanTest, AnAllocationThatTheDriverRefusesIsAnErrorWithoutTrace) {
    if (device().info().kind != PT_DEVICE_CPU)
        GTEST_SKIP() << "a limit on the process's memory limits CPU devices only";
    const std::uint64_t before = device().allocated_bytes();
    rlimit unlimited{};
    ASSERT_EQ(getrlimit(RLIMIT_AS, &unlimited), 0);
    const rlimit none_left{1, unlimited.rlim_max};
    ASSERT_EQ(setrlimit(RLIMIT_AS, &none_left), 0);
    std::optional<pt::Error> error;
    try {
        Buffer(device(), BufferUse::Storage, 1U << 30, "film");
    } catch (const pt::Error &thrown) {
        error = thrown;
    }
    ASSERT_EQ(setrlimit(RLIMIT_AS, &unlimited), 0);
    ASSERT_TRUE(error);
    EXPECT_EQ(error->code(), PT_ERROR_OUT_OF_DEVICE_MEMORY);
    EXPECT_TRUE(names(*error, "1073741824 bytes for the film")) << error->what();
    EXPECT_EQ(device().allocated_bytes(), before);
    messages_.clear();
    clear_all(device(), Buffer(device(), BufferUse::Storage, 1U << 20, "film"));
}
#endif

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
