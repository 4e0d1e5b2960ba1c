// Makes a chosen Vulkan call fail, and tracks live objects. The linker replaces vkGetInstanceProcAddr (--wrap).
#pragma once

#include <vulkan/vulkan_core.h>

#include <cstddef>
#include <cstdint>
#include <map>
#include <string>

namespace faults {

// The injected result.
struct CallFault {
    std::string function; // empty: not reached
    VkResult result = VK_SUCCESS;
    std::size_t error_count = 0; // errors that Vulkan allows the function
};

// The number-th call that can fail, from 1 (0: none), returns the function's error_index-th error, modulo their count.
// A submission with VK_TIMEOUT is made but never seen to end; each look takes a tenth of a second by the library's
// clock. A wait with VK_TIMEOUT takes an hour, as after a stopped process.
void fail_call(std::size_t number, std::size_t error_index);

CallFault call_fault();

// Lost and hung devices work again.
void heal_devices();

// Devices claim to be discrete GPUs: staging buffers, two submissions at a time, limited patience.
void pose_as_gpu(bool pose);

void limit_memory(std::uint64_t bytes);

// By maker. Descriptor sets and command buffers are not counted.
std::map<std::string, long> live_objects();

// Live objects stay until the process ends, uncounted.
void forget_objects();

} // namespace faults
