// A compute kernel, specialised, with the buffers that it is bound to.
#pragma once

#include "lib/vulkan/buffer.h"
#include "lib/vulkan/device.h"
#include "lib/vulkan/device_object.h"

#include <cstddef>
#include <cstdint>
#include <span>

namespace pt::vulkan {

// Buffers bound to a kernel. They must outlive the last dispatch with it.
class DescriptorSet {
public:
    vk::DescriptorSet handle() const { return set_; }

private:
    friend class ComputePipeline;
    DeviceObject<vk::raii::DescriptorPool> pool_;
    vk::DescriptorSet set_; // freed with its pool
};

// Stands for a number that no binding has.
inline constexpr auto no_binding = static_cast<vk::DescriptorType>(VK_DESCRIPTOR_TYPE_MAX_ENUM);

class ComputePipeline {
public:
    // bindings[i] is the type of binding i of set 0, or no_binding; constants[i] are the bits of the specialization constant with id
    // i. Throws PT_ERROR_SHADER if the driver refuses the kernel.
    ComputePipeline(Device &device, std::span<const std::uint32_t> spirv, std::span<const vk::DescriptorType> bindings,
                    std::uint32_t push_constant_bytes, std::span<const std::uint32_t> constants);

    // buffers[i] goes to binding i; NULL where there is none.
    DescriptorSet bind(std::span<Buffer *const> buffers) const;

    // Records a dispatch of group_count workgroups along x, and rows of them along y. offsets: of the dynamic bindings
    // into their buffers, in bytes.
    void dispatch(const vk::raii::CommandBuffer &commands, const DescriptorSet &set,
                  std::span<const std::byte> push_constants, std::uint32_t group_count,
                  std::span<const std::uint32_t> offsets = {}, std::uint32_t rows = 1) const;

private:
    Device *device_;
    std::vector<vk::DescriptorType> bindings_;
    DeviceObject<vk::raii::DescriptorSetLayout> set_layout_;
    DeviceObject<vk::raii::PipelineLayout> layout_;
    DeviceObject<vk::raii::Pipeline> pipeline_;
};

} // namespace pt::vulkan
