// Selection by properties; see memory_type.h.
#include "lib/vulkan/memory_type.h"

#include <algorithm>

namespace pt::vulkan {

std::vector<std::uint32_t> memory_types(const vk::PhysicalDeviceMemoryProperties &memory, std::uint32_t allowed,
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

} // namespace pt::vulkan
