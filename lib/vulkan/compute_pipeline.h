#pragma once

#include "lib/vulkan/buffer.h"
#include "lib/vulkan/device.h"
#include "lib/vulkan/device_object.h"

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace pt::vulkan {

// Offsets must be multiples of Limits::storage_buffer_alignment, or of 256 bytes for texels.
struct BufferRange {
    BufferRange() = default;
    BufferRange(const Buffer &whole) : buffer(whole.handle()), bytes(whole.size()) {}
    BufferRange(vk::Buffer of, std::uint64_t first, std::uint64_t count) : buffer(of), offset(first), bytes(count) {}

    vk::Buffer buffer;
    std::uint64_t offset = 0;
    std::uint64_t bytes = 0;
};

inline constexpr vk::Format texel_format = vk::Format::eR32G32B32A32Uint;
inline constexpr std::uint64_t texel_bytes = 16;

// The buffers must outlive the last dispatch.
class DescriptorSet {
public:
    vk::DescriptorSet handle() const { return set_; }

private:
    friend class ComputePipeline;
    std::vector<DeviceObject<vk::raii::BufferView>> views_;
    DeviceObject<vk::raii::DescriptorPool> pool_;
    vk::DescriptorSet set_;
};

struct Binding {
    std::uint32_t number;
    vk::DescriptorType type = vk::DescriptorType::eStorageBuffer;
};

class ComputePipeline {
public:
    // constants[i] is the value of constant_id i. Throws PT_ERROR_SHADER if the driver rejects the kernel.
    ComputePipeline(Device &device, std::span<const std::uint32_t> spirv, std::span<const Binding> bindings,
                    std::uint32_t push_constant_bytes, std::span<const std::uint32_t> constants);

    DescriptorSet bind(std::span<const BufferRange> ranges) const;

    // Records group_count x rows workgroups. `offsets` are the offsets of the dynamic bindings in bytes.
    void dispatch(const vk::raii::CommandBuffer &commands, const DescriptorSet &set,
                  std::span<const std::byte> push_constants, std::uint32_t group_count,
                  std::span<const std::uint32_t> offsets = {}, std::uint32_t rows = 1) const;

private:
    Device *device_;
    std::vector<Binding> bindings_;
    DeviceObject<vk::raii::DescriptorSetLayout> set_layout_;
    DeviceObject<vk::raii::PipelineLayout> layout_;
    DeviceObject<vk::raii::Pipeline> pipeline_;
};

} // namespace pt::vulkan
