// A VkDevice with one queue for compute, as the library makes it for itself. Used by Device.
#pragma once

#include "lib/vulkan/api.h"

#include <cstdint>

namespace pt::vulkan {

// A queue family for compute, preferably one without graphics: that is meant for background work.
std::uint32_t compute_family(const vk::raii::PhysicalDevice &device);

// With one queue of that family. Throws vk::SystemError.
vk::raii::Device create_device(const vk::raii::PhysicalDevice &physical_device, std::uint32_t queue_family);

} // namespace pt::vulkan
