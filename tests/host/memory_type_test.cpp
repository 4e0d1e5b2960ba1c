// The choice among invented types of memory, and heaps that are full.
#include "lib/vulkan/memory_type.h"

#include "tests/support/expected_error.h"

#include <gtest/gtest.h>

#include <array>
#include <cstdint>
#include <vector>

namespace {

using Property = vk::MemoryPropertyFlagBits;
using Types = std::vector<std::uint32_t>;

// A GPU's own memory, the host's, and a window onto the GPU's that the host sees.
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

TEST(MemoryType, ThoseWithTheFirstWantedPropertiesComeFirst) {
    EXPECT_EQ(pt::vulkan::memory_types(gpu_memory(), all, fast_then_any), (Types{0, 2, 1}));
    EXPECT_EQ(pt::vulkan::memory_types(gpu_memory(), all, seen_best_fast), (Types{2, 1}));
}

TEST(MemoryType, OnlyAllowedOnesAreTaken) {
    EXPECT_EQ(pt::vulkan::memory_types(gpu_memory(), 3, seen_best_fast), Types{1});
    EXPECT_EQ(error_of([] { pt::vulkan::memory_types(gpu_memory(), 1, seen_best_fast); }).code(), PT_ERROR_UNSUPPORTED);
}

TEST(MemoryType, AFullHeapLeavesTheNextType) {
    const Types types = {0, 2, 1};
    Types tried;
    const auto only_the_hosts = [&](std::uint32_t type) {
        tried.push_back(type);
        if (type != 1)
            throw vk::OutOfDeviceMemoryError("full");
        return type;
    };
    EXPECT_EQ(pt::vulkan::allocate_where_there_is_room(types, only_the_hosts), 1U);
    EXPECT_EQ(tried, types);
    EXPECT_THROW(pt::vulkan::allocate_where_there_is_room(Types{0, 2}, only_the_hosts), vk::OutOfDeviceMemoryError);
}

TEST(MemoryType, OtherErrorsAreNotTriedAgain) {
    int calls = 0;
    const auto lost = [&](std::uint32_t) -> int {
        ++calls;
        throw vk::DeviceLostError("lost");
    };
    EXPECT_THROW(pt::vulkan::allocate_where_there_is_room(Types{0, 1}, lost), vk::DeviceLostError);
    EXPECT_EQ(calls, 1);
}

} // namespace
