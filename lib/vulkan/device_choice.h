// Describes the Vulkan devices and picks one.
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

// Index of the device that pt_create_info.device asks for, "" for the best. Throws PT_ERROR_NO_DEVICE, with a reason
// for each device, if none fits.
std::size_t choose_device(std::span<const pt_device_info> devices, const std::string &wanted);

// Indices of the devices that pt_create_info.device asks for, one or several, at least one and each once. Throws
// likewise, and PT_ERROR_INVALID_ARGUMENT if a list names a device twice.
std::vector<std::size_t> choose_devices(std::span<const pt_device_info> devices, const std::string &wanted);

} // namespace pt::vulkan
