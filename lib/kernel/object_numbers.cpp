#include "lib/kernel/object_numbers.h"

#include "lib/kernel/gpu_scene.h"

namespace pt {

namespace {

constexpr std::uint32_t no_surface = 0xffffffff; // NO_SURFACE of shaders/scene.glsl

} // namespace

ObjectNumbers::ObjectNumbers(const PreparedScene &scene, const Camera &camera, const RenderSettings &settings) :
    tree_(scene.tree) {
    const Scene &held = scene.scene;
    const auto of_sphere = [&](std::uint32_t index) { return held.indices.empty() ? index : held.indices[index]; };
    const std::uint32_t sphere_count =
        tree_ ? tree_->scene_sphere_count() : static_cast<std::uint32_t>(held.spheres.size());
    const KernelSurfaces surfaces = surfaces_of(scene, camera, settings);
    for (const SeenSphere &sphere : surfaces.spheres)
        numbers_.push_back(of_sphere(sphere.index));
    for (const CurvedPlane &plane : surfaces.planes) {
        const bool is_sphere = plane.curvature > 0.0;
        numbers_.push_back(is_sphere ? of_sphere(plane.index) : sphere_count + plane.index);
    }
}

std::uint32_t ObjectNumbers::of_surface(std::uint32_t surface) const {
    if (surface == no_surface)
        return PT_NO_OBJECT;
    return surface < numbers_.size() ? numbers_[surface] : tree_->spheres()[surface - numbers_.size()];
}

} // namespace pt
