// Counts how many camera rays meet a surface (shaders/coverage.comp), by tracing the camera rays of the samples again.
// So the film needs no fourth channel. Owned by RenderDevice, which makes it when it is first asked for.
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
    // Both arguments must outlive the object.
    Coverage(vulkan::Device &device, std::span<const std::uint32_t> code);

    // Takes over a scene, unless it has that one already; see SceneKernel::show().
    void show(const std::shared_ptr<const GpuScene> &scene, const vulkan::Buffer *tree);

    // Calls receive(counts) for consecutive pieces of the pixels, row by row, of the scene that is shown.
    // tests_per_submission: how many tests of rays against surfaces one submission should take. Throws
    // PT_ERROR_INTERNAL if a driver lost work.
    using Receive = std::function<void(std::span<const std::uint32_t>)>;
    void read(const CoverageQuery &query, double tests_per_submission, const Receive &receive);

private:
    // The buffers that one piece needs.
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
