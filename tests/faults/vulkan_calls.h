// Makes a chosen Vulkan call fail, and counts live objects. The linker option --wrap replaces vkGetInstanceProcAddr and
// the library's clock, which advances only on request. Slices are then reproducible, and hung devices take no time.
#pragma once

#include <vulkan/vulkan_core.h>

#include <chrono>
#include <cstddef>
#include <cstdint>
#include <map>
#include <string>

namespace faults {

struct CallFault {
    std::string function; // empty if no call was reached
    VkResult result = VK_SUCCESS;
    std::size_t error_count = 0;
};

// Fails one call. `number`, from 1, counts the calls that can fail. 0 stops failures. `error_index`, modulo the
// length of the function's list of errors, chooses the error. VK_TIMEOUT for a submission means that its work never
// ends and each poll takes 0.1 s in the library's clock. VK_TIMEOUT for a wait takes an hour.
void fail_call(std::size_t number, std::size_t error_index);

CallFault call_fault();

void heal_devices();

void pass_time(std::chrono::nanoseconds duration);

// Lets the CPU pose as a discrete GPU, with staging buffers, two submissions at a time, and a time limit.
void pose_as_gpu(bool pose);

void limit_memory(std::uint64_t bytes);

// Counts objects by the function that made them. Descriptor sets and command buffers are left out.
std::map<std::string, long> live_objects();

// Leaves the present objects out of the count.
void forget_objects();

} // namespace faults
