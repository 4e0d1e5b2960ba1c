#pragma once

#include "lib/vulkan/api.h"

#include <pt/devices.h>
#include <pt/pt.h>

#include <cstddef>
#include <span>
#include <string>
#include <vector>

namespace pt::vulkan {

pt_device_info describe(const vk::raii::PhysicalDevice &device);

// Finds the device that pt_create_info.device names, or the best one for "". Throws PT_ERROR_NO_DEVICE with a reason
// for each device.
std::size_t choose_device(std::span<const pt_device_info> devices, const std::string &wanted);

// Throws PT_ERROR_INVALID_ARGUMENT if a list names a device twice.
std::vector<std::size_t> choose_devices(std::span<const pt_device_info> devices, const std::string &wanted);

} // namespace pt::vulkan
