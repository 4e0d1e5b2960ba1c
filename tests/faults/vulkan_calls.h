// Makes a chosen Vulkan call fail, and tracks live objects. The linker replaces vkGetInstanceProcAddr (--wrap).
#pragma once

#include <vulkan/vulkan_core.h>

#include <cstddef>
#include <cstdint>
#include <map>
#include <string>

namespace faults {

struct CallFault {
    std::string function; // empty: not reached
    VkResult result = VK_SUCCESS;
    std::size_t error_count = 0;
};

// The number-th call that can fail, from 1 (0: none), returns the function's error_index-th error, modulo their count.
// A submission with VK_TIMEOUT is made but never ends; each look takes 0.1 s by the library's clock. A wait with
// VK_TIMEOUT takes an hour.
void fail_call(std::size_t number, std::size_t error_index);

CallFault call_fault();

void heal_devices();

// Devices pose as discrete GPUs, with staging buffers, two submissions at a time and a time limit.
void pose_as_gpu(bool pose);

void limit_memory(std::uint64_t bytes);

// By maker, without descriptor sets and command buffers.
std::map<std::string, long> live_objects();

// Live objects stay until the process ends, uncounted.
void forget_objects();

} // namespace faults
