#include "lib/kernel/scene_kernel.h"

#include "lib/base/error.h"
#include "lib/code/specialised_pipeline.h"
#include "shaders/gpu_layout.h"

#include <algorithm>
#include <string>
#include <utility>

namespace pt {

std::vector<vulkan::Binding> with_scene_bindings(std::initializer_list<vulkan::Binding> further) {
    std::vector<vulkan::Binding> bindings = {{gpu::BINDING_SCENE_UNIFORM, vk::DescriptorType::eUniformBuffer},
                                             {gpu::BINDING_SCENE_STORAGE},
                                             {gpu::BINDING_TREE_NODES, vk::DescriptorType::eUniformTexelBuffer},
                                             {gpu::BINDING_TREE_SPHERES, vk::DescriptorType::eUniformTexelBuffer}};
    bindings.insert(bindings.end(), further);
    return bindings;
}

std::vector<vulkan::BufferRange> scene_ranges(const View &view, const vulkan::Buffer &words,
                                              const vulkan::Buffer *tree) {
    if (!tree)
        return {words, words, {words.handle(), 0, vulkan::texel_bytes}, {words.handle(), 0, vulkan::texel_bytes}};
    const std::uint64_t node_bytes = view.tree->node_words().size_bytes();
    return {words,
            words,
            {tree->handle(), 0, node_bytes},
            {tree->handle(), node_bytes, view.tree->sphere_words().size_bytes()}};
}

SceneKernel::SceneKernel(vulkan::Device &device, std::span<const std::uint32_t> code,
                         std::vector<vulkan::Binding> bindings, std::uint32_t push_constant_bytes) :
    device_(device),
    code_(code),
    bindings_(std::move(bindings)),
    push_constant_bytes_(push_constant_bytes) {}

void SceneKernel::fit(std::span<const std::uint32_t> constants) {
    if (pipeline_ && std::ranges::equal(constants_, constants))
        return;
    pipeline_.reset();
    pipeline_.emplace(specialised_pipeline(device_, code_, bindings_, push_constant_bytes_, constants));
    constants_.assign(constants.begin(), constants.end());
}

vulkan::DescriptorSet SceneKernel::bind(const BoundScene &bound,
                                        std::initializer_list<vulkan::BufferRange> ranges) const {
    std::vector<vulkan::BufferRange> all = bound.ranges;
    all.insert(all.end(), ranges);
    return pipeline_->bind(all);
}

void SceneKernel::dispatch(const vk::raii::CommandBuffer &commands, const vulkan::DescriptorSet &set,
                           std::span<const std::byte> push_constants, std::uint64_t invocations) const {
    const std::uint64_t groups = (invocations + gpu::WORKGROUP_SIZE - 1) / gpu::WORKGROUP_SIZE;
    pipeline_->dispatch(commands, set, push_constants, static_cast<std::uint32_t>(groups));
}

std::uint64_t SceneKernel::pixels_at_once(std::uint64_t pixels, std::uint32_t rays_of_pixel, double rays) const {
    constexpr std::uint64_t most = 1U << 18;
    const std::uint64_t dispatched =
        std::uint64_t{device_.limits().max_workgroup_count} * gpu::WORKGROUP_SIZE / rays_of_pixel;
    const std::uint64_t affordable = static_cast<std::uint64_t>(rays) / rays_of_pixel;
    return std::min({std::max<std::uint64_t>(affordable, gpu::WORKGROUP_SIZE), dispatched, most, pixels});
}

double rays_for(double tests, const View &view) {
    return std::clamp(tests / surface_tests_per_ray(view.features, view.tree.get()), 1.0, 0x1p48);
}

void require_all_met(std::uint32_t lost_pixels) {
    if (lost_pixels > 0)
        throw Error(PT_ERROR_INTERNAL, "the driver stopped camera rays of " + std::to_string(lost_pixels) +
                                           " pixels before they hit anything");
}

} // namespace pt
