#pragma once

#include "lib/vulkan/api.h"

#include <cstdint>

namespace pt::vulkan {

// Prefers a family without graphics, which is meant for background work.
std::uint32_t compute_family(const vk::raii::PhysicalDevice &device);

vk::raii::Device create_device(const vk::raii::PhysicalDevice &physical_device, std::uint32_t queue_family);

} // namespace pt::vulkan
