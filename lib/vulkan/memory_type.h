#pragma once

#include "lib/base/error.h"
#include "lib/vulkan/api.h"

#include <algorithm>
#include <cstdint>
#include <span>
#include <vector>

namespace pt::vulkan {

// Returns the allowed types that have one of the wanted sets of properties, best first. Bit i of `allowed` is type i.
// Throws PT_ERROR_UNSUPPORTED if there are none.
inline std::vector<std::uint32_t> memory_types(const vk::PhysicalDeviceMemoryProperties &memory, std::uint32_t allowed,
                                               std::span<const vk::MemoryPropertyFlags> wanted_best_first) {
    std::vector<std::uint32_t> types;
    for (const vk::MemoryPropertyFlags wanted : wanted_best_first)
        for (std::uint32_t i = 0; i < memory.memoryTypeCount; ++i) {
            const bool fits = (allowed >> i & 1) != 0 && (memory.memoryTypes[i].propertyFlags & wanted) == wanted;
            if (fits && std::ranges::find(types, i) == types.end())
                types.push_back(i);
        }
    if (types.empty())
        throw Error(PT_ERROR_UNSUPPORTED, "the device has no memory of the kind that a buffer needs");
    return types;
}

// Returns allocate(type) for the first type whose heap has room. Rethrows the last failure.
template <typename Allocate>
auto allocate_where_there_is_room(std::span<const std::uint32_t> types, Allocate &&allocate) {
    for (const std::uint32_t type : types.first(types.size() - 1)) {
        try {
            return allocate(type);
        } catch (const vk::OutOfDeviceMemoryError &) {
            continue;
        }
    }
    return allocate(types.back());
}

} // namespace pt::vulkan
