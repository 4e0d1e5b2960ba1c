// Which of a device's types of memory a buffer gets.
#pragma once

#include "lib/base/error.h"
#include "lib/vulkan/api.h"

#include <cstdint>
#include <span>
#include <vector>

namespace pt::vulkan {

// Indices of the types among those allowed (bit i stands for type i) that have all of some wanted properties: those
// with the first of them come first, and each comes once. Throws PT_ERROR_UNSUPPORTED if there is none.
std::vector<std::uint32_t> memory_types(const vk::PhysicalDeviceMemoryProperties &memory, std::uint32_t allowed,
                                        std::span<const vk::MemoryPropertyFlags> wanted_best_first);

// What allocate(type) returns of the first type whose heap has room. Throws what it threw last if none has.
template <typename Allocate>
auto allocate_where_there_is_room(std::span<const std::uint32_t> types, Allocate &&allocate) {
    for (const std::uint32_t type : types.first(types.size() - 1)) {
        try {
            return allocate(type);
        } catch (const vk::OutOfDeviceMemoryError &) {
            continue; // its heap is full: the next type may lie in another
        }
    }
    return allocate(types.back());
}

} // namespace pt::vulkan
