#include "lib/kernel/first_hits.h"

#include "lib/code/specialised_pipeline.h"
#include "lib/film/pixel_format.h"
#include "shaders/gpu_layout.h"

#include <algorithm>

namespace pt {

FirstHits::FirstHits(vulkan::Device &device, std::span<const std::uint32_t> code) :
    device_(device),
    kernel_(device, code, with_scene_bindings({{gpu::BINDING_RESOLVED}, {gpu::BINDING_FINDINGS}}),
            sizeof(gpu::FirstHitConstants)) {}

void FirstHits::read(const BoundScene &bound, const FirstHitQuery &query, double tests_per_submission,
                     const Receive &receive) {
    auto fitted = specialization_constants(bound.view.features);
    set_device_constants(fitted, device_);
    kernel_.fit(fitted);
    const std::uint32_t rays = gpu::rays_of_pixel(query.quantity);
    const std::uint64_t total = query.pixels.pixel_count();
    const std::uint64_t most = kernel_.pixels_at_once(total, rays, rays_for(tests_per_submission, bound.view));
    const std::uint64_t bytes_of_pixel = pixel_bytes(query.format);
    if (!results_ || results_->room() < most * bytes_of_pixel) {
        results_.reset();
        results_.emplace(device_, most * bytes_of_pixel, "first hits");
    }
    const vulkan::DescriptorSet set = kernel_.bind(bound, {results_->pixels(), results_->findings()});
    gpu::FirstHitConstants constants{};
    constants.camera = bound.view.frame.camera;
    constants.start_distance = static_cast<float>(bound.view.start_distance);
    constants.quantity = query.quantity;
    constants.format = query.format;
    constants.first_pixel = query.pixels.y * constants.camera.width + query.pixels.x;
    constants.rectangle_width = query.pixels.width;
    for (std::uint64_t done = 0; done < total; done += constants.pixel_count) {
        constants.first_of_rectangle = static_cast<std::uint32_t>(done);
        constants.pixel_count = static_cast<std::uint32_t>(std::min(most, total - done));
        const std::uint64_t bytes = constants.pixel_count * bytes_of_pixel;
        device_.submit([&](const vk::raii::CommandBuffer &commands) {
            results_->clear(commands);
            vulkan::barrier_between_commands(commands);
            kernel_.dispatch(commands, set, std::as_bytes(std::span(&constants, 1)),
                             std::uint64_t{constants.pixel_count} * rays);
            vulkan::barrier_between_commands(commands);
            results_->hand_over(commands, bytes);
        });
        require_all_met(results_->lost_pixels());
        receive(results_->bytes().first(bytes));
    }
}

} // namespace pt
