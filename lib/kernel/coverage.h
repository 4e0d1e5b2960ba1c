// Counts the camera rays that meet a surface (shaders/coverage.comp) by tracing them again, so that the film needs no
// fourth channel. Owned by RenderDevice, made on first use.
#pragma once

#include "lib/film/film_header.h"
#include "lib/film/tile_samples.h"
#include "lib/kernel/scene_kernel.h"
#include "lib/scene/render_settings.h"
#include "lib/vulkan/buffer.h"
#include "shaders/gpu_layout.h"

#include <cstdint>
#include <functional>
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

    // Calls receive(counts) for consecutive pieces of the pixels, row by row. tests_per_submission: aim for the
    // ray-surface tests of a submission. Throws PT_ERROR_SHADER if the driver refuses the kernel, PT_ERROR_INTERNAL if
    // it lost work.
    using Receive = std::function<void(std::span<const std::uint32_t>)>;
    void read(const BoundScene &bound, const CoverageQuery &query, double tests_per_submission, const Receive &receive);

private:
    // Buffers of a piece.
    struct Buffers {
        vulkan::Buffer covered; // lost rays, then counts
        vulkan::Buffer host;    // the same
        vulkan::Buffer points;
        vulkan::Buffer tile_ranges;
    };

    // Arguments of one read.
    struct Look {
        const Features &features;
        const CoverageQuery &query;
        double rays; // of a submission
        vulkan::DescriptorSet set;
    };

    void make_room(std::uint64_t pixels, std::size_t tiles);
    std::uint64_t samples_in_dispatch(const Features &features, double affordable) const;
    void count(const Look &look, gpu::CoverageConstants constants);
    void take(const Look &look, const gpu::CoverageConstants &constants);

    vulkan::Device &device_;
    SceneKernel kernel_;
    std::optional<Buffers> buffers_;
};

} // namespace pt
