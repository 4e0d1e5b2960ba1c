// Counts the camera rays of samples that meet a surface (shaders/coverage.comp), by taking the same rays again: so that
// the path tracer's film needs no fourth channel. Owned by RenderDevice, once it has been asked for.
#pragma once

#include "lib/film/film_header.h"
#include "lib/film/tile_samples.h"
#include "lib/kernel/gpu_scene.h"
#include "lib/kernel/scene_kernel.h"
#include "lib/scene/render_settings.h"
#include "lib/vulkan/buffer.h"
#include "lib/vulkan/compute_pipeline.h"
#include "lib/vulkan/device.h"
#include "shaders/gpu_layout.h"

#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <span>

namespace pt {

struct CoverageQuery {
    Rectangle pixels;               // of the film, at least one
    const TileSamples &samples;     // of the film
    const RenderSettings &settings; // by which they were taken
};

class Coverage {
public:
    // Both must outlive it.
    Coverage(vulkan::Device &device, std::span<const std::uint32_t> code);

    // Takes a scene over, unless it has it; see SceneKernel::show().
    void show(const std::shared_ptr<const GpuScene> &scene, const vulkan::Buffer *tree);

    // Of the scene that is shown: calls receive(counts) for consecutive pieces of the pixels, row by row.
    // tests_per_submission: that are worth one, between rays and surfaces. Throws PT_ERROR_INTERNAL if a driver lost
    // work.
    using Receive = std::function<void(std::span<const std::uint32_t>)>;
    void read(const CoverageQuery &query, double tests_per_submission, const Receive &receive);

private:
    // What a piece takes.
    struct Buffers {
        vulkan::Buffer covered; // rays that were lost, then the counts
        vulkan::Buffer host;    // the same
        vulkan::Buffer points;
        vulkan::Buffer tile_ranges;
        vulkan::DescriptorSet set;
    };

    Buffers &buffers(std::uint64_t pixels, std::size_t tiles);
    std::uint64_t samples_in_dispatch(double affordable) const;
    void count(const CoverageQuery &query, gpu::CoverageConstants constants, double tests_per_submission,
               Buffers &buffers);
    void take(const CoverageQuery &query, const gpu::CoverageConstants &constants, Buffers &buffers);

    vulkan::Device &device_;
    SceneKernel kernel_;
    gpu::CoverageConstants constants_{}; // of the scene that is shown
    Features features_{};                // likewise
    std::optional<Buffers> buffers_;
};

} // namespace pt
