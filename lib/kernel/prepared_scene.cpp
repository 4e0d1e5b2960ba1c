// Finds what does not depend on the camera; see prepared_scene.h.
#include "lib/kernel/prepared_scene.h"

#include "lib/scene/lamp_tree.h"
#include "lib/scene/scene_digest.h"
#include "lib/scene/twins.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace pt {

namespace {

// Of the scene's materials, whether some surface has them.
std::vector<bool> is_used(const Scene &scene) {
    std::vector<bool> used(scene.materials.size());
    for (const Sphere &sphere : scene.spheres)
        used[sphere.material] = true;
    for (const Plane &plane : scene.planes)
        used[plane.material] = true;
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

PreparedScene::PreparedScene(Scene of) :
    scene(std::move(of)),
    sphere_order(order_along_line(scene.spheres)),
    lamp_order(order_in_lamp_tree(scene)) {
    const std::vector<bool> used = is_used(scene);
    for (std::size_t i = 0; i < used.size(); ++i) {
        used_indices.push_back(static_cast<std::uint32_t>(used_materials.size()));
        if (used[i])
            used_materials.push_back(scene.materials[i]);
    }
    film_unit = pt::film_unit(used_materials);
    gloss = std::ranges::any_of(used_materials, is_glossy);
    moves = std::ranges::any_of(scene.spheres, [](const Sphere &sphere) { return sphere.motion != glm::dvec3(0.0); });
}

const std::string &PreparedScene::digest() const {
    if (digest_.empty())
        digest_ = digest_of(scene);
    return digest_;
}

} // namespace pt
