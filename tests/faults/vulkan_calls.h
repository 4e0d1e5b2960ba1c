// Stands between the library and Vulkan: makes a chosen call fail, and knows the objects that are alive. The library
// gets its functions from vkGetInstanceProcAddr, which the linker replaces by this one (--wrap).
#pragma once

#include <vulkan/vulkan_core.h>

#include <cstddef>
#include <cstdint>
#include <map>
#include <string>

namespace faults {

// What a call returned in Vulkan's place.
struct CallFault {
    std::string function; // empty: the call was not reached
    VkResult result = VK_SUCCESS;
    std::size_t error_count = 0; // of those that Vulkan allows the function
};

// The call with a number, counted from 1 over those that can fail, returns the function's error with an index, modulo
// their number. 0: none does. A submission that returns VK_TIMEOUT is made, but is never seen to end: each look at it
// takes a tenth of a second by the library's clock. A wait that returns it takes an hour of it, as if the process had
// been stopped meanwhile; the work goes on.
void fail_call(std::size_t number, std::size_t error_index);

// What came of it.
CallFault call_fault();

// Whether what was made is undone: a device that was lost or hangs does so no more.
void heal_devices();

// Devices say that they are discrete GPUs, which the library uses in other ways: with staging buffers, two
// submissions at a time, and an end to its patience.
void pose_as_gpu(bool pose);

// Devices say that each of their heaps has no more than so many bytes.
void limit_memory(std::uint64_t bytes);

// Vulkan objects by the name of what made them. Descriptor sets and command buffers go with their
// pools, and are not counted.
std::map<std::string, long> live_objects();

// Those that are alive, which are left to the end of the process, count no more.
void forget_objects();

} // namespace faults
