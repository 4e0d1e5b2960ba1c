#include "lib/vulkan/buffer.h"
#include "lib/vulkan/device.h"
#include "tests/vulkan/device_fixture.h"

#include "lib/base/error.h"
#include "lib/code/shader_source.h"
#include "lib/kernel/accuracy.h"
#include "tests/support/expected_error.h"
#include "tests/vulkan/held_work.h"
#include "tests/vulkan/recurrence.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <chrono>
#include <cstddef>
#include <cstdint>
#include <new>
#include <string>

namespace {

using pt::vulkan::Buffer;
using pt::vulkan::BufferUse;
using pt::vulkan::Device;
using VulkanTest = VulkanFixture;

TEST_F(VulkanTest, AFailureWhileRecordingLeavesTheDeviceUsable) {
    Recurrence recurrence(device(), 1);
    recurrence.start_with(zeros(recurrence.value_count()));
    EXPECT_THROW(device().submit([&](const vk::raii::CommandBuffer &commands) {
        recurrence.record(commands, 1);
        throw std::bad_alloc();
    }),
                 std::bad_alloc);
    EXPECT_FALSE(device().lost());
    EXPECT_EQ(download(recurrence.values(), 0, 1)[0], 0U);
    recurrence.run(1);
    EXPECT_EQ(download(recurrence.values(), 0, 1)[0], Recurrence::expected(0, 1));
}

TEST_F(VulkanTest, ADeviceThatDoesNotEndASubmissionIsLostForGood) {
    Device &device = device_with({.patience = std::chrono::nanoseconds{0},
                                  .share_memory = true,
                                  .scene_in_constants = false,
                                  .invocations = 0,
                                  .queue_depth = 1});
    const HeldWork gate(device.handle());
    Recurrence recurrence(device, 256);
    const pt::Error loss = error_of([&] { device.submit([&](const auto &commands) { gate.record(commands); }); });
    EXPECT_EQ(loss.code(), PT_ERROR_DEVICE_LOST);
    EXPECT_TRUE(device.lost());
    std::array<std::byte, 4> word{};
    const std::array<pt::Error, 6> later = {
        error_of([&] { device.require_alive(); }),
        error_of([&] { recurrence.run(1); }),
        error_of([&] { recurrence.values().upload(word, 0); }),
        error_of([&] { recurrence.values().download(word, 0); }),
        error_of([&] { Buffer(device, BufferUse::Storage, 1024, "test"); }),
        error_of([&] { pt::measured_accuracy(device, pt::embedded_code().accuracy); }),
    };
    for (const pt::Error &error : later) {
        EXPECT_EQ(error.code(), PT_ERROR_DEVICE_LOST);
        EXPECT_STREQ(error.what(), loss.what());
    }
    gate.open(); // ends the work, unlike a hung device
}

// After too many rounds, a driver may end loops without an error.
TEST_F(VulkanTest, KernelsRunAllLoopTripsOfTheBudget) {
    constexpr std::uint64_t enough = 1U << 20;
    const auto steps = static_cast<std::uint32_t>(std::min(device().limits().loop_trip_budget, enough));
    Recurrence recurrence(device(), 1);
    recurrence.start_with(zeros(recurrence.value_count()));
    recurrence.run(steps);
    EXPECT_EQ(download(recurrence.values(), 0, 1)[0], Recurrence::expected(0, steps));
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
