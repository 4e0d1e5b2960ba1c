// Tests of lib/vulkan/ on a real device: transfers, kernels, messages, errors, loss.
#include "lib/vulkan/buffer.h"
#include "lib/vulkan/compute_pipeline.h"
#include "lib/vulkan/device.h"
#include "tests/device/vulkan_fixture.h"

#include "lib/base/error.h"
#include "lib/kernel/accuracy.h"
#include "lib/kernel/shader_source.h"
#include "recurrence.spv.h"
#include "tests/device/gate.h"
#include "tests/support/expected_error.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <chrono>
#include <numeric>
#include <optional>
#include <string>
#include <vector>

#include <sys/resource.h>

namespace {

using pt::vulkan::Buffer;
using pt::vulkan::BufferUse;
using pt::vulkan::ComputePipeline;
using pt::vulkan::DescriptorSet;
using pt::vulkan::Device;
using pt::vulkan::DevicePolicy;
using VulkanTest = VulkanFixture;

void clear_all(Device &device, const Buffer &buffer) {
    device.submit([&](const vk::raii::CommandBuffer &commands) { buffer.clear(commands, 0, buffer.size()); });
}

// The kernel recurrence.comp: values[i] becomes what step makes of values[i] + offset, step by step.
class Recurrence {
public:
    static constexpr std::uint32_t multiplier = 1664525;
    static constexpr std::uint32_t increment = 1013904223;
    static constexpr std::uint32_t offset = 41;

    Recurrence(Device &device, std::uint32_t group_count) :
        device_(device),
        group_count_(group_count),
        pipeline_(device, recurrence_spirv,
                  std::array{vk::DescriptorType::eUniformBuffer, vk::DescriptorType::eStorageBuffer}, 4,
                  std::array{multiplier, increment}),
        offset_(device, BufferUse::UniformOrStorage, 1U << 17, "offset"),
        values_(device, BufferUse::Storage, value_count() * 4, "values"),
        set_(pipeline_.bind(std::array{&offset_, &values_})) {}

    std::size_t value_count() const { return std::size_t{group_count_} * 64; }
    Buffer &values() { return values_; }

    // Fills the kernel's buffers.
    void start_with(std::span<const std::uint32_t> values) {
        const std::array words = {offset, 0U, 0U, 0U};
        offset_.upload(std::as_bytes(std::span(words)), 0);
        values_.upload(std::as_bytes(values), 0);
    }

    static std::uint32_t expected(std::uint32_t value, std::uint32_t steps) {
        value += offset;
        for (std::uint32_t i = 0; i < steps; ++i)
            value = value * multiplier + increment;
        return value;
    }

    void record(const vk::raii::CommandBuffer &commands, std::uint32_t steps) const {
        pipeline_.dispatch(commands, set_, std::as_bytes(std::span(&steps, 1)), group_count_);
    }

    double run(std::uint32_t steps) {
        return device_.submit([&](const vk::raii::CommandBuffer &commands) { record(commands, steps); });
    }

private:
    Device &device_;
    std::uint32_t group_count_;
    ComputePipeline pipeline_;
    Buffer offset_;
    Buffer values_;
    DescriptorSet set_;
};

std::vector<std::uint32_t> counting(std::size_t count) {
    std::vector<std::uint32_t> values(count);
    std::iota(values.begin(), values.end(), 1000U);
    return values;
}

std::vector<std::uint32_t> zeros(std::size_t count) {
    return std::vector<std::uint32_t>(count, 0U);
}

void upload(Buffer &buffer, std::span<const std::uint32_t> values, std::size_t first = 0) {
    buffer.upload(std::as_bytes(values), first * 4);
}

std::vector<std::uint32_t> download(Buffer &buffer, std::size_t first, std::size_t count) {
    std::vector<std::uint32_t> values(count);
    buffer.download(std::as_writable_bytes(std::span(values)), first * 4);
    return values;
}

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

TEST_F(VulkanTest, CountsAllocatedBytes) {
    const std::uint64_t before = device().allocated_bytes();
    {
        Buffer first(device(), BufferUse::Storage, 4096, "first");
        EXPECT_EQ(device().allocated_bytes(), before + 4096);
        Buffer second(device(), BufferUse::UniformOrStorage, 1024, "second");
        EXPECT_EQ(device().allocated_bytes(), before + 5120);
        first = std::move(second);
        EXPECT_EQ(device().allocated_bytes(), before + 1024);
        EXPECT_EQ(first.size(), 1024U);
    }
    EXPECT_EQ(device().allocated_bytes(), before);
}

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

TEST_F(VulkanTest, ADescriptorSetMayReplaceAnother) {
    const ComputePipeline pipeline(device(), recurrence_spirv,
                                   std::array{vk::DescriptorType::eUniformBuffer, vk::DescriptorType::eStorageBuffer},
                                   4, {});
    Buffer buffer(device(), BufferUse::UniformOrStorage, 1024, "test");
    const std::array buffers = {&buffer, &buffer};
    DescriptorSet set = pipeline.bind(buffers);
    set = pipeline.bind(buffers);
    const std::uint32_t steps = 1;
    device().submit([&](const vk::raii::CommandBuffer &commands) {
        pipeline.dispatch(commands, set, std::as_bytes(std::span(&steps, 1)), 1);
    });
}

// A streamed buffer holds offsets for dispatches of one submission: each sees the one that its dynamic offset says.
TEST_F(VulkanTest, ADynamicOffsetChoosesThePartOfAStreamedBuffer) {
    constexpr std::array bindings = {vk::DescriptorType::eUniformBufferDynamic, vk::DescriptorType::eStorageBuffer};
    constexpr std::array keep_the_sum = {1U, 0U};
    const ComputePipeline pipeline(device(), recurrence_spirv, bindings, 4, keep_the_sum);
    const std::uint32_t range = device().limits().max_uniform_range;
    Buffer offsets(device(), BufferUse::Streamed, std::uint64_t{3} * range, "offsets");
    Buffer values(device(), BufferUse::Storage, 64 * 4, "values");
    const DescriptorSet set = pipeline.bind(std::array{&offsets, &values});
    const std::uint32_t steps = 1;
    for (const std::uint32_t round : {0U, 1U}) { // the second writes over what the first has read
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

#ifndef __SANITIZE_ADDRESS__ // its own memory is beyond any limit
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
    messages_.clear(); // the driver reports it too
    clear_all(device(), Buffer(device(), BufferUse::Storage, 1U << 20, "film"));
}
#endif

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
    const Gate gate(device.handle());
    Recurrence recurrence(device, 256); // fills no buffer: with no patience at all the first submission is the last
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
    gate.open(); // this device does end it, and then its buffers may go
}

TEST_F(VulkanTest, ALongSubmissionIsWaitedFor) {
    Recurrence recurrence(device(), 256);
    recurrence.start_with(zeros(recurrence.value_count()));
    EXPECT_GT(recurrence.run(60'000), 0.0);
    EXPECT_EQ(download(recurrence.values(), 16383, 1)[0], Recurrence::expected(0, 60'000));
}

TEST_F(VulkanTest, ASubmissionIsWaitedForUntilATime) {
    const Gate gate(device().handle());
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

// Nobody knows then how long it took, only that it was no longer than until somebody looked.
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
