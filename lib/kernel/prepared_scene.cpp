// Finds what does not depend on the camera; see prepared_scene.h.
#include "lib/kernel/prepared_scene.h"

#include "lib/scene/twins.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace pt {

namespace {

// Of the materials that some surface has.
std::vector<Material> used_materials(const Scene &scene) {
    std::vector<bool> is_used(scene.materials.size());
    for (const Sphere &sphere : scene.spheres)
        is_used[sphere.material] = true;
    for (const Plane &plane : scene.planes)
        is_used[plane.material] = true;
    std::vector<Material> used;
    for (std::size_t i = 0; i < is_used.size(); ++i)
        if (is_used[i])
            used.push_back(scene.materials[i]);
    return used;
}

double film_unit(const std::vector<Material> &materials) {
    float brightest = 0.0F;
    for (const Material &material : materials)
        brightest = std::max({brightest, material.emission.r, material.emission.g, material.emission.b});
    if (brightest == 0.0F)
        return 1.0;
    int exponent = 0; // brightest = fraction * 2^exponent with fraction in [1/2, 1)
    std::frexp(brightest, &exponent);
    // The kernel multiplies by 1 / unit, which must be a normal float32.
    return std::ldexp(1.0, std::clamp(exponent - 8, -120, 120));
}

} // namespace

PreparedScene::PreparedScene(Scene of) : scene(std::move(of)), sphere_order(order_along_line(scene.spheres)) {
    const std::vector<Material> materials = used_materials(scene);
    film_unit = pt::film_unit(materials);
    gloss = std::ranges::any_of(materials, is_glossy);
    moves = std::ranges::any_of(scene.spheres, [](const Sphere &sphere) { return sphere.motion != glm::dvec3(0.0); });
}

} // namespace pt
