#include "lib/vulkan/buffer.h"
#include "lib/vulkan/compute_pipeline.h"
#include "lib/vulkan/device.h"
#include "recurrence.spv.h"
#include "tests/support/expected_error.h"
#include "tests/vulkan/device_fixture.h"
#include "tests/vulkan/held_work.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <chrono>
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <numeric>
#include <span>
#include <string>
#include <vector>

namespace {

using pt::vulkan::Buffer;
using pt::vulkan::BufferUse;
using pt::vulkan::ComputePipeline;
using pt::vulkan::DescriptorSet;
using pt::vulkan::Device;
using pt::vulkan::Instance;
using VulkanTest = VulkanFixture;
using Integers = std::vector<std::uint32_t>;

void upload(Buffer &buffer, std::span<const std::uint32_t> values, std::size_t first = 0) {
    buffer.upload(std::as_bytes(values), first * 4);
}

Integers download(Buffer &buffer, std::size_t first, std::size_t count) {
    Integers values(count);
    buffer.download(std::as_writable_bytes(std::span(values)), first * 4);
    return values;
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
            upload(offsets, words, std::size_t{part} * range / 4);
            expected += part == 1 ? 0 : words[0];
        }
        device().submit([&](const vk::raii::CommandBuffer &commands) {
            values.clear(commands, 0, values.size());
            pt::vulkan::barrier_between_commands(commands);
            for (const std::uint32_t part : {2U, 0U}) {
                pipeline.dispatch(commands, set, std::as_bytes(std::span(&steps, 1)), 1, std::array{part * range});
                pt::vulkan::barrier_between_commands(commands);
            }
        });
        EXPECT_EQ(download(values, 0, 64), Integers(64, expected));
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

TEST_F(VulkanTest, TransfersReachTheirRangeOnly) {
    for (const bool in_place : {true, false}) {
        SCOPED_TRACE(in_place ? "in place" : "staged");
        Device &device = device_with({.patience = std::chrono::hours{1},
                                      .share_memory = in_place,
                                      .scene_in_constants = false,
                                      .invocations = 0,
                                      .queue_depth = 1});
        Integers values((33U << 20) / 4 + 3);
        std::iota(values.begin(), values.end(), 1000U);
        Buffer buffer(device, BufferUse::Storage, values.size() * 4, "test");
        upload(buffer, values);
        EXPECT_TRUE(download(buffer, 0, values.size()) == values);
        const std::array patch = {7U, 8U, 9U};
        upload(buffer, patch, 500);
        upload(buffer, {}, 0);
        std::ranges::copy(patch, values.begin() + 500);
        EXPECT_TRUE(download(buffer, 0, values.size()) == values);
        const std::size_t first = (15U << 20) / 4 + 1;
        const std::size_t count = (17U << 20) / 4;
        EXPECT_TRUE(std::ranges::equal(download(buffer, first, count), std::span(values).subspan(first, count)));
        EXPECT_EQ(device.allocated_bytes(), buffer.size() + (in_place ? 0U : 16U << 20));
        buffer = Buffer(device, BufferUse::Storage, 4, "test");
        EXPECT_EQ(device.allocated_bytes(), 4U);
    }
}

TEST_F(VulkanTest, ASubmissionIsWaitedForUntilATime) {
    const HeldWork gate(device().handle());
    const Device::Ticket ticket = device().start([&](const auto &commands) { gate.record(commands); });
    EXPECT_FALSE(device().is_done(ticket, Device::Clock::time_point::min()));
    EXPECT_FALSE(device().is_done(ticket, Device::Clock::now() + std::chrono::milliseconds{5}));
    device().look();
    EXPECT_FALSE(device().is_done(ticket, Device::Clock::now()));
    gate.open();
    EXPECT_TRUE(device().is_done(ticket, Device::Clock::time_point::max()));
    EXPECT_TRUE(device().is_done(ticket, Device::Clock::time_point::min()));
    EXPECT_GE(device().finish(ticket), 5e-3);
}

TEST_F(VulkanTest, ASubmissionMayEndUnseen) {
    const auto seconds_of = [&](double expected, bool seen) {
        const Device::Ticket ticket = device().start([](const auto &) {});
        if (!seen) {
            device().handle().waitIdle();
            device().look();
        }
        return device().finish(ticket, expected);
    };
    EXPECT_EQ(seconds_of(0.0, false), 0.0);
    EXPECT_EQ(seconds_of(1e-12, false), 1e-12) << "what was expected may be so";
    EXPECT_LT(seconds_of(1e9, false), 1e6);
    EXPECT_GT(seconds_of(0.0, true), 0.0);
    EXPECT_GT(seconds_of(1e-12, true), 1e-12);
}

template <typename Call>
pt::Error error_with(const char *variable, const char *value, const Call &call) {
    const char *const found = std::getenv(variable);
    const std::string before = found ? found : "";
    setenv(variable, value, 1);
    pt::Error error = error_of(call);
    if (found)
        setenv(variable, before.c_str(), 1);
    else
        unsetenv(variable);
    return error;
}

TEST(VulkanInstanceTest, WithoutADriverThereIsNoDevice) {
    const pt::Error error = error_with("VK_DRIVER_FILES", "/nonexistent/driver.json",
                                       [] { (void)Instance(pt::Log{}, false).physical_devices(); });
    EXPECT_EQ(error.code(), PT_ERROR_NO_DEVICE);
    for (const char *part :
         {"VK_DRIVER_FILES=/nonexistent/driver.json", "ErrorIncompatibleDriver", "mesa-vulkan-drivers"})
        EXPECT_TRUE(names(error, part)) << error.what();
}

TEST(VulkanInstanceTest, WithoutTheLayerValidationIsUnsupported) {
    const pt::Error error = error_with("VK_LAYER_PATH", "/nonexistent", [] { Instance(pt::Log{}, true); });
    EXPECT_EQ(error.code(), PT_ERROR_UNSUPPORTED);
    EXPECT_TRUE(names(error, "VK_LAYER_KHRONOS_validation")) << error.what();
}

// Negative control.
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
