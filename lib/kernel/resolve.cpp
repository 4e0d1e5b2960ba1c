#include "lib/kernel/resolve.h"

#include "lib/base/error.h"

#include <cmath>
#include <string>

namespace pt {

const vulkan::ComputePipeline &ResolvePipelines::of(std::uint32_t format) {
    constexpr vulkan::Binding bindings[] = {{gpu::BINDING_FILM}, {gpu::BINDING_RESOLVED}, {gpu::BINDING_FINDINGS}};
    std::optional<vulkan::ComputePipeline> &pipeline = pipelines_.at(format);
    if (!pipeline)
        pipeline.emplace(device_, code_, bindings, sizeof(gpu::ResolveConstants), std::array{format});
    return *pipeline;
}

void resolve(const vk::raii::CommandBuffer &commands, const vulkan::ComputePipeline &pipeline, const DeviceFilm &film,
             std::span<const vulkan::DescriptorSet> sets, const ImageQuery &query, const ResolvedPiece &piece) {
    gpu::ResolveConstants constants{};
    constants.sample_counts = gpu::uvec2(gpu::ANY_COUNT);
    if (query.samples)
        constants.sample_counts = {static_cast<std::uint32_t>((*query.samples)[older_part]),
                                   static_cast<std::uint32_t>((*query.samples)[newer_part])};
    constants.exponent = std::ilogb(query.unit) - static_cast<int>(gpu::FILM_FRACTION_BITS);
    constants.quantity = query.quantity;
    constants.film_width = film.width();
    constants.first_pixel = piece.pixels.y * film.width() + piece.pixels.x;
    constants.width = piece.pixels.width;
    constants.pixel_count = static_cast<std::uint32_t>(piece.pixels.pixel_count());
    constants.first_word = piece.first_word;
    constants.row_words = piece.row_words;
    vulkan::barrier_between_commands(commands);
    for (std::size_t i = 0; i < sets.size(); ++i) {
        const DeviceFilm::Strip &strip = film.strips()[i];
        constants.strip_first_pixel = strip.first_pixel;
        constants.strip_pixel_count = strip.pixel_count;
        const std::uint32_t groups = (constants.pixel_count + gpu::WORKGROUP_SIZE - 1) / gpu::WORKGROUP_SIZE;
        pipeline.dispatch(commands, sets[i], std::as_bytes(std::span(&constants, 1)), groups);
    }
    vulkan::barrier_between_commands(commands);
}

void require_no_loss(std::uint32_t lost_pixels) {
    if (lost_pixels > 0)
        throw Error(PT_ERROR_INTERNAL, "the driver lost samples of " + std::to_string(lost_pixels) + " pixels");
}

} // namespace pt
