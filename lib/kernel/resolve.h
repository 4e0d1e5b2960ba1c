#pragma once

#include "lib/film/film_header.h"
#include "lib/film/pixel_format.h"
#include "lib/kernel/device_film.h"
#include "lib/vulkan/compute_pipeline.h"
#include "lib/vulkan/device.h"
#include "shaders/gpu_layout.h"

#include <array>
#include <cstdint>
#include <optional>
#include <span>

namespace pt {

struct ImageQuery {
    Rectangle pixels;
    std::uint32_t quantity;
    double unit;
    std::optional<PartCounts> samples;
    std::uint32_t format = PT_FORMAT_RGB32F;
};

class ResolvePipelines {
public:
    ResolvePipelines(vulkan::Device &device, std::span<const std::uint32_t> code) : device_(device), code_(code) {}

    // Builds the pipeline of a format on first use. A descriptor set for one format can be used with all.
    const vulkan::ComputePipeline &of(std::uint32_t format);

private:
    vulkan::Device &device_;
    std::span<const std::uint32_t> code_;
    std::array<std::optional<vulkan::ComputePipeline>, format_count> pipelines_;
};

struct ResolvedPiece {
    Rectangle pixels;
    std::uint32_t first_word;
    std::uint32_t row_words;
};

void resolve(const vk::raii::CommandBuffer &commands, const vulkan::ComputePipeline &pipeline, const DeviceFilm &film,
             std::span<const vulkan::DescriptorSet> sets, const ImageQuery &query, const ResolvedPiece &piece);

void require_no_loss(std::uint32_t lost_pixels);

} // namespace pt
