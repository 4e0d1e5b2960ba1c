// Specialization constants that depend on the device alone, not on the scene. Set for every kernel that traces rays,
// and for the kernels that measure its functions.
#pragma once

#include "lib/vulkan/device.h"
#include "shaders/specialization.h"

#include <cstdint>
#include <span>

namespace pt {

inline void set_device_constants(std::span<std::uint32_t> constants, const vulkan::DevicePolicy &policy) {
    constants[gpu::ID_UNROLLED] = policy.unrolled;
    constants[gpu::ID_INTEGER_ORDER] = policy.compiles_for_cpu ? 1 : 0;
}

} // namespace pt
