// A kernel that looks at the scene beside the path tracer's, fitted to the scene like that. Owned by FirstHits and by
// Coverage.
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

// What kernels read of a scene: the bindings, with further ones behind them, and the buffers for these. words: the
// scene buffer; tree: that of its tree, NULL if it has none. Kernels for scenes without a tree have the bindings all
// the same.
std::vector<vulkan::Binding> with_scene_bindings(std::initializer_list<vulkan::Binding> further);
std::vector<vulkan::BufferRange> scene_ranges(const GpuScene &scene, const vulkan::Buffer &words,
                                              const vulkan::Buffer *tree);

// A scene and its buffers on a device, from scene_ranges().
struct BoundScene {
    const GpuScene &scene;
    std::vector<vulkan::BufferRange> ranges;
};

class SceneKernel {
public:
    // The device, and the code, must outlive the object. bindings: with those of the scene.
    SceneKernel(vulkan::Device &device, std::span<const std::uint32_t> code, std::vector<vulkan::Binding> bindings,
                std::uint32_t push_constant_bytes);

    // Fits the kernel to scenes with these features. constants: by constant_id. Throws PT_ERROR_SHADER if the driver
    // refuses the kernel.
    void fit(std::span<const std::uint32_t> constants);

    // ranges: for the bindings that follow those of the scene.
    vulkan::DescriptorSet bind(const BoundScene &bound, std::initializer_list<vulkan::BufferRange> ranges) const;
    void dispatch(const vk::raii::CommandBuffer &commands, const vulkan::DescriptorSet &set,
                  std::span<const std::byte> push_constants, std::uint64_t invocations) const;

    // How many of so many pixels one submission should look at: no more than a dispatch can, and as many as rays may be
    // traced for their rays_of_pixel each.
    std::uint64_t pixels_at_once(std::uint64_t pixels, std::uint32_t rays_of_pixel, double rays) const;

private:
    vulkan::Device &device_;
    std::span<const std::uint32_t> code_;
    std::vector<vulkan::Binding> bindings_;
    std::uint32_t push_constant_bytes_;
    std::vector<std::uint32_t> constants_; // of the pipeline
    std::optional<vulkan::ComputePipeline> pipeline_;
};

// How many rays amount to this many tests of rays against surfaces; at least one.
double rays_for(double tests, const GpuScene &scene);

// Throws PT_ERROR_INTERNAL if a driver stopped rays of some pixels.
void require_all_met(std::uint32_t lost_pixels);

} // namespace pt
