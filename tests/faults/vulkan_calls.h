// Makes a chosen Vulkan call fail, and counts live objects. The linker replaces vkGetInstanceProcAddr (--wrap).
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

// Fails one call. `number` counts the calls that can fail from 1, and 0 means that none fails. `error_index` chooses
// the error from the function's list, modulo its length. A submission with VK_TIMEOUT is made but never ends, and each
// poll of it takes 0.1 s in the library's clock. A wait with VK_TIMEOUT takes an hour.
void fail_call(std::size_t number, std::size_t error_index);

CallFault call_fault();

void heal_devices();

// Devices look like discrete GPUs with staging buffers, two submissions at a time, and a time limit.
void pose_as_gpu(bool pose);

void limit_memory(std::uint64_t bytes);

// Counts objects by the function that made them, without descriptor sets and command buffers.
std::map<std::string, long> live_objects();

// Live objects stay until the process ends, but no longer count.
void forget_objects();

} // namespace faults
