// A further kernel that reads the scene and is specialised to it.
#pragma once

#include "lib/kernel/gpu_scene.h"
#include "lib/vulkan/compute_pipeline.h"
#include "lib/vulkan/device.h"

#include <cstddef>
#include <cstdint>
#include <initializer_list>
#include <optional>
#include <span>
#include <vector>

namespace pt {

// The scene's bindings, before further ones, and their buffers. words: the scene buffer. tree: the tree buffer, or
// NULL; the bindings do not depend on it.
std::vector<vulkan::Binding> with_scene_bindings(std::initializer_list<vulkan::Binding> further);
std::vector<vulkan::BufferRange> scene_ranges(const GpuScene &scene, const vulkan::Buffer &words,
                                              const vulkan::Buffer *tree);

struct BoundScene {
    const GpuScene &scene;
    std::vector<vulkan::BufferRange> ranges;
};

class SceneKernel {
public:
    // bindings: including the scene's.
    SceneKernel(vulkan::Device &device, std::span<const std::uint32_t> code, std::vector<vulkan::Binding> bindings,
                std::uint32_t push_constant_bytes);

    // constants: by constant_id. Throws PT_ERROR_SHADER if the driver refuses the kernel.
    void fit(std::span<const std::uint32_t> constants);

    // ranges: for the bindings after the scene's.
    vulkan::DescriptorSet bind(const BoundScene &bound, std::initializer_list<vulkan::BufferRange> ranges) const;
    void dispatch(const vk::raii::CommandBuffer &commands, const vulkan::DescriptorSet &set,
                  std::span<const std::byte> push_constants, std::uint64_t invocations) const;

    // Pixels per submission, limited by a dispatch and by `rays`.
    std::uint64_t pixels_at_once(std::uint64_t pixels, std::uint32_t rays_of_pixel, double rays) const;

private:
    vulkan::Device &device_;
    std::span<const std::uint32_t> code_;
    std::vector<vulkan::Binding> bindings_;
    std::uint32_t push_constant_bytes_;
    std::vector<std::uint32_t> constants_;
    std::optional<vulkan::ComputePipeline> pipeline_;
};

// Rays that amount to these tests; at least one.
double rays_for(double tests, const GpuScene &scene);

// Throws PT_ERROR_INTERNAL unless 0.
void require_all_met(std::uint32_t lost_pixels);

} // namespace pt
