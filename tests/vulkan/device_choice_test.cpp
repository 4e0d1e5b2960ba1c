#include "lib/vulkan/caller_vulkan.h"
#include "lib/vulkan/device.h"
#include "lib/vulkan/device_choice.h"
#include "lib/vulkan/memory_type.h"

#include "tests/support/expected_error.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <chrono>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

namespace {

pt_device_info invented(std::uint32_t kind, const std::string &name, std::uint8_t uuid = 0) {
    pt_device_info info{};
    info.kind = kind;
    info.suitable = 1;
    std::ranges::copy(name, info.name);
    std::ranges::fill(info.uuid, uuid);
    return info;
}

pt_device_info unsuitable(pt_device_info info, const std::string &reason) {
    info.suitable = 0;
    std::ranges::copy(reason, info.reason);
    return info;
}

const std::vector<pt_device_info> workstation = {
    invented(PT_DEVICE_OTHER, "Abacus", 0x10),
    invented(PT_DEVICE_CPU, "llvmpipe (LLVM 15)", 0x11),
    invented(PT_DEVICE_VIRTUAL_GPU, "Virtio Venus", 0x12),
    invented(PT_DEVICE_INTEGRATED_GPU, "Radeon Vega 8", 0x13),
    unsuitable(invented(PT_DEVICE_DISCRETE_GPU, "GeForce 9800", 0x14), "Vulkan 1.2 is needed"),
    invented(PT_DEVICE_DISCRETE_GPU, "Radeon RX 7900", 0xab),
    invented(PT_DEVICE_DISCRETE_GPU, "GeForce RTX 4090", 0x16),
};

TEST(DeviceChoiceTest, TheBestIsTheFirstOfTheBestKind) {
    constexpr std::array best_first = {5U, 6U, 3U, 2U, 1U, 0U};
    std::vector<pt_device_info> devices = workstation;
    for (const std::size_t expected : best_first) {
        EXPECT_EQ(pt::vulkan::choose_device(devices, ""), expected);
        devices[expected] = unsuitable(devices[expected], "removed");
    }
    EXPECT_EQ(error_of([&] { pt::vulkan::choose_device(devices, ""); }).code(), PT_ERROR_NO_DEVICE);
}

TEST(DeviceChoiceTest, GpusAreWaitedForInBoundedTime) {
    for (const pt_device_info &device : workstation) {
        const bool is_cpu = device.kind == PT_DEVICE_CPU;
        const pt::vulkan::DevicePolicy policy = pt::vulkan::default_policy(device);
        EXPECT_EQ(policy.patience, is_cpu ? std::chrono::nanoseconds::max() : std::chrono::seconds{10}) << device.name;
        EXPECT_EQ(policy.scene_in_constants, is_cpu) << device.name;
    }
}

TEST(DeviceChoiceTest, AnIndexAKindAUuidOrAPartOfANameChoosesOne) {
    const struct {
        const char *wish;
        std::size_t expected;
    } cases[] = {{"0", 0},
                 {"06", 6},
                 {"cpu", 1},
                 {"gpu", 5},
                 {"LLVM", 1},
                 {"rtx 40", 6},
                 {"radeon", 5},
                 {"GeForce", 6},
                 {"12121212-1212-1212-1212-121212121212", 2},
                 {"11111111111111111111111111111111", 1},
                 {"ABABABABABABABABABABABABABABABAB", 5}};
    for (const auto &[wish, expected] : cases)
        EXPECT_EQ(pt::vulkan::choose_device(workstation, wish), expected) << wish;
    EXPECT_EQ(pt::vulkan::choose_device(std::span(workstation).first(4), "gpu"), 3U);
}

TEST(DeviceChoiceTest, ARefusalSaysWhatIsThere) {
    const auto refusal = [](std::span<const pt_device_info> devices, const std::string &wish) {
        const pt::Error error = error_of([&] { pt::vulkan::choose_device(devices, wish); });
        EXPECT_EQ(error.code(), PT_ERROR_NO_DEVICE) << wish;
        EXPECT_TRUE(names(error, wish)) << error.what();
        return error;
    };
    for (const char *const outside : {"7", "4090", "99999999999999999999"})
        EXPECT_TRUE(names(refusal(workstation, outside), "below 7"));
    EXPECT_TRUE(names(refusal(workstation, "4"), "GeForce 9800"));
    EXPECT_TRUE(names(refusal(workstation, "4"), "Vulkan 1.2 is needed"));
    refusal(std::span(workstation).first(2), "gpu");
    refusal(std::span(workstation).last(2), "cpu");
    refusal(workstation, std::string(32, 'c'));
    const pt::Error error = refusal(workstation, "Voodoo");
    for (const pt_device_info &device : workstation)
        EXPECT_TRUE(names(error, device.name)) << error.what();
    EXPECT_TRUE(names(error, "GeForce 9800: Vulkan 1.2 is needed")) << error.what();
}

TEST(DeviceChoiceTest, SeveralAreAListOrAllOfTheBestKind) {
    using Indices = std::vector<std::size_t>;
    EXPECT_EQ(pt::vulkan::choose_devices(workstation, ""), (Indices{5}));
    EXPECT_EQ(pt::vulkan::choose_devices(workstation, "all"), (Indices{5, 6}));
    EXPECT_EQ(pt::vulkan::choose_devices(workstation, "ALL"), (Indices{5, 6}));
    EXPECT_EQ(pt::vulkan::choose_devices(workstation, "6,1"), (Indices{6, 1}));
    EXPECT_EQ(pt::vulkan::choose_devices(workstation, "3,16161616-16161616-1616161616161616"), (Indices{3, 6}));
    EXPECT_EQ(pt::vulkan::choose_devices(workstation, "llvm"), (Indices{1}));
    const std::vector<pt_device_info> with_comma = {invented(PT_DEVICE_CPU, "llvmpipe (LLVM 15, 256 bits)", 0x11)};
    EXPECT_EQ(pt::vulkan::choose_devices(with_comma, "15, 256"), (Indices{0}));
    for (const std::string wrong : {"5,7", "5,4", "5,", ",", "5,vega"})
        EXPECT_EQ(error_of([&] { pt::vulkan::choose_devices(workstation, wrong); }).code(), PT_ERROR_NO_DEVICE)
            << wrong;
}

TEST(DeviceChoiceTest, NoDeviceIsChosenTwice) {
    std::vector<pt_device_info> devices = workstation;
    devices.push_back(devices[5]);
    for (const std::string twice : {"5,5", "3,5,3", "5,abababab-abab-abab-abab-abababababab", "7,5"}) {
        const pt::Error error = error_of([&] { pt::vulkan::choose_devices(devices, twice); });
        EXPECT_EQ(error.code(), PT_ERROR_INVALID_ARGUMENT) << twice;
        EXPECT_TRUE(names(error, "create.device = \"" + twice + "\": must not name a device twice")) << error.what();
    }
    EXPECT_EQ(pt::vulkan::choose_devices(devices, "all"), (std::vector<std::size_t>{5, 6}));
    const std::vector<pt_device_info> nameless = {invented(PT_DEVICE_CPU, "a"), invented(PT_DEVICE_CPU, "b")};
    EXPECT_EQ(error_of([&] { pt::vulkan::choose_devices(nameless, "1,1"); }).code(), PT_ERROR_INVALID_ARGUMENT);
    EXPECT_EQ(pt::vulkan::choose_devices(nameless, "0,1"), (std::vector<std::size_t>{0, 1}));
    EXPECT_EQ(pt::vulkan::choose_devices(nameless, "all"), (std::vector<std::size_t>{0, 1}));
}

using Flag = vk::QueueFlagBits;

const std::array families = {
    vk::QueueFamilyProperties{.queueFlags = Flag::eGraphics | Flag::eCompute, .queueCount = 1},
    vk::QueueFamilyProperties{.queueFlags = Flag::eTransfer, .queueCount = 2},
    vk::QueueFamilyProperties{.queueFlags = Flag::eCompute, .queueCount = 8},
};

TEST(CallerVulkan, AQueueFamilyMustCompute) {
    EXPECT_NO_THROW(pt::vulkan::require_compute(families, 0));
    EXPECT_NO_THROW(pt::vulkan::require_compute(families, 2));
    EXPECT_STREQ(error_of([] { pt::vulkan::require_compute(families, 1); }).what(),
                 "vulkan.queue_family = 1: must have VK_QUEUE_COMPUTE_BIT");
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

using Property = vk::MemoryPropertyFlagBits;
using Types = std::vector<std::uint32_t>;

vk::PhysicalDeviceMemoryProperties gpu_memory() {
    vk::PhysicalDeviceMemoryProperties memory;
    memory.memoryTypeCount = 3;
    memory.memoryTypes[0].propertyFlags = Property::eDeviceLocal;
    memory.memoryTypes[1].propertyFlags = Property::eHostVisible | Property::eHostCoherent;
    memory.memoryTypes[2].propertyFlags = Property::eDeviceLocal | Property::eHostVisible | Property::eHostCoherent;
    return memory;
}

constexpr std::array<vk::MemoryPropertyFlags, 2> fast_then_any = {Property::eDeviceLocal, vk::MemoryPropertyFlags{}};
constexpr std::array<vk::MemoryPropertyFlags, 2> seen_best_fast = {Property::eDeviceLocal | Property::eHostVisible,
                                                                   Property::eHostVisible};
constexpr std::uint32_t all = 7;

TEST(MemoryType, AllowedOnesWithTheFirstWantedPropertiesComeFirst) {
    EXPECT_EQ(pt::vulkan::memory_types(gpu_memory(), all, fast_then_any), (Types{0, 2, 1}));
    EXPECT_EQ(pt::vulkan::memory_types(gpu_memory(), all, seen_best_fast), (Types{2, 1}));
    EXPECT_EQ(pt::vulkan::memory_types(gpu_memory(), 3, seen_best_fast), Types{1});
    EXPECT_EQ(error_of([] { pt::vulkan::memory_types(gpu_memory(), 1, seen_best_fast); }).code(), PT_ERROR_UNSUPPORTED);
}

TEST(MemoryType, AFullHeapAloneLeavesTheNextType) {
    Types tried;
    const auto only_the_hosts = [&](std::uint32_t type) {
        tried.push_back(type);
        if (type == 2)
            throw vk::DeviceLostError("lost");
        if (type == 0)
            throw vk::OutOfDeviceMemoryError("full");
        return type;
    };
    EXPECT_EQ(pt::vulkan::allocate_where_there_is_room(Types{0, 1, 2}, only_the_hosts), 1U);
    EXPECT_EQ(tried, (Types{0, 1}));
    EXPECT_THROW(pt::vulkan::allocate_where_there_is_room(Types{0}, only_the_hosts), vk::OutOfDeviceMemoryError);
    EXPECT_THROW(pt::vulkan::allocate_where_there_is_room(Types{2, 1}, only_the_hosts), vk::DeviceLostError);
}

} // namespace
