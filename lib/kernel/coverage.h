// Counts the camera rays that hit a surface (shaders/coverage.comp). Traces the rays again, so the film needs no fourth
// channel.
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
    Rectangle pixels;
    const TileSamples &samples;
    const RenderSettings &settings;
};

class Coverage {
public:
    Coverage(vulkan::Device &device, std::span<const std::uint32_t> code);

    // receive(counts) gets consecutive pieces of the pixels, row by row.
    using Receive = std::function<void(std::span<const std::uint32_t>)>;
    void read(const BoundScene &bound, const CoverageQuery &query, double tests_per_submission, const Receive &receive);

private:
    struct Buffers {
        vulkan::Buffer covered;
        vulkan::Buffer host;
        vulkan::Buffer points;
        vulkan::Buffer tile_ranges;
    };

    struct Look {
        const Features &features;
        const CoverageQuery &query;
        double rays;
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
