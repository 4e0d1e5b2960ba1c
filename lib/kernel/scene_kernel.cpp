#include "lib/kernel/scene_kernel.h"

#include "lib/kernel/specialised_code.h"
#include "shaders/gpu_layout.h"

#include <algorithm>

namespace pt {

// The camera and the places of surfaces may change for nothing but new words.
void SceneKernel::show(const std::shared_ptr<const GpuScene> &scene, const vulkan::Buffer *tree,
                       std::span<const std::uint32_t> constants) {
    scene_.reset();
    if (!pipeline_ || !std::ranges::equal(constants_, constants))
        build(constants);
    const std::uint64_t bytes =
        std::max<std::uint64_t>(scene->words.size(), gpu::UNIFORM_SCENE_WORDS) * sizeof(glm::vec4);
    if (!words_ || words_->size() < bytes) {
        words_.reset();
        words_.emplace(device_, vulkan::BufferUse::UniformOrStorage, bytes, "scene that is looked at");
    }
    words_->upload(std::as_bytes(std::span(scene->words)), 0);
    tree_nodes_ = {words_->handle(), 0, vulkan::texel_bytes};
    tree_spheres_ = tree_nodes_;
    if (tree) {
        const std::uint64_t node_bytes = scene->tree->node_words().size_bytes();
        tree_nodes_ = {tree->handle(), 0, node_bytes};
        tree_spheres_ = {tree->handle(), node_bytes, scene->tree->sphere_words().size_bytes()};
    }
    tests_per_ray_ = surface_tests_per_ray(scene->features, scene->tree.get());
    scene_ = scene;
}

void SceneKernel::build(std::span<const std::uint32_t> constants) {
    pipeline_.reset();
    const std::vector<std::uint32_t> code = specialised_code(code_.spirv, constants);
    if (code.empty())
        pipeline_.emplace(device_, code_.spirv, code_.bindings, code_.push_constant_bytes, constants);
    else
        pipeline_.emplace(device_, code, code_.bindings, code_.push_constant_bytes, std::span<const std::uint32_t>{});
    constants_.assign(constants.begin(), constants.end());
}

void SceneKernel::bind_scene(std::span<vulkan::BufferRange> ranges) const {
    ranges[gpu::BINDING_SCENE_UNIFORM] = vulkan::BufferRange(*words_);
    ranges[gpu::BINDING_SCENE_STORAGE] = vulkan::BufferRange(*words_);
    ranges[gpu::BINDING_TREE_NODES] = tree_nodes_;
    ranges[gpu::BINDING_TREE_SPHERES] = tree_spheres_;
}

double SceneKernel::rays_for(double tests) const {
    return std::clamp(tests / tests_per_ray_, 1.0, 0x1p48);
}

} // namespace pt
