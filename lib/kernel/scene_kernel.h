// A kernel that looks at the scene beside the path tracer's: fitted to the scene like that, with buffers of its own, so
// that nothing of it is there unless it is asked for. Owned by FirstHits and by Coverage.
#pragma once

#include "lib/kernel/gpu_scene.h"
#include "lib/vulkan/buffer.h"
#include "lib/vulkan/compute_pipeline.h"
#include "lib/vulkan/device.h"

#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <vector>

namespace pt {

class SceneKernel {
public:
    struct Code {
        std::span<const std::uint32_t> spirv;
        std::span<const vk::DescriptorType>
            bindings; // those of the scene and the tree at their numbers of gpu_layout.h
        std::uint32_t push_constant_bytes;
    };

    // The device, and the code that is referred to, must outlive the object.
    SceneKernel(vulkan::Device &device, const Code &code) : device_(device), code_(code) {}

    // Whether it is showing this scene.
    bool shows(const std::shared_ptr<const GpuScene> &scene) const { return scene_.lock() == scene; }

    // Takes over another scene; earlier bindings are void. tree: the buffer of the scene's tree, NULL if it has none;
    // it must stay until the next scene. constants: the kernel's, by constant_id. Throws PT_ERROR_SHADER if the driver
    // refuses the kernel.
    void show(const std::shared_ptr<const GpuScene> &scene, const vulkan::Buffer *tree,
              std::span<const std::uint32_t> constants);

    // For the scene that it shows: the pipeline, and its buffers at the bindings that they belong to.
    const vulkan::ComputePipeline &pipeline() const { return *pipeline_; }
    void bind_scene(std::span<vulkan::BufferRange> ranges) const;

    // How many rays amount to this many tests of rays against surfaces; at least one.
    double rays_for(double tests) const;

private:
    void build(std::span<const std::uint32_t> constants);

    vulkan::Device &device_;
    Code code_;
    std::vector<std::uint32_t> constants_; // of the pipeline
    std::optional<vulkan::ComputePipeline> pipeline_;
    std::weak_ptr<const GpuScene> scene_; // a scene of many spheres is not kept for this
    std::optional<vulkan::Buffer> words_; // its
    vulkan::BufferRange tree_nodes_;
    vulkan::BufferRange tree_spheres_;
    double tests_per_ray_ = 1.0;
};

} // namespace pt
