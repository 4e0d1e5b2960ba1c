#pragma once

#include "lib/code/specialised_code.h"
#include "lib/points/point_sequence.h"
#include "lib/vulkan/compute_pipeline.h"
#include "lib/vulkan/device.h"
#include "shaders/specialization.h"

#include <cstdint>
#include <span>
#include <vector>

namespace pt {

inline void set_device_constants(std::span<std::uint32_t> constants, const vulkan::Device &device) {
    constants[gpu::ID_UNROLLED] = device.policy().unrolled;
    constants[gpu::ID_INTEGER_ORDER] = device.policy().compiles_for_cpu ? 1 : 0;
    constants[gpu::ID_POINT_BLOCKS] = device.limits().max_uniform_range / std::uint32_t{sizeof(PointBlock)};
}

inline vulkan::ComputePipeline specialised_pipeline(vulkan::Device &device, std::span<const std::uint32_t> spirv,
                                                    std::span<const vulkan::Binding> bindings,
                                                    std::uint32_t push_constant_bytes,
                                                    std::span<const std::uint32_t> constants) {
    const std::vector<std::uint32_t> code = specialised_code(spirv, constants);
    if (code.empty())
        return {device, spirv, bindings, push_constant_bytes, constants};
    return {device, code, bindings, push_constant_bytes, {}};
}

} // namespace pt
