// A scene with what is known of it wherever the camera is: made once by pt_set_scene, held by Renderer, read by gpu_scene.
#pragma once

#include "lib/scene/scene.h"
#include "lib/tree/sphere_tree.h"

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace pt {

struct PreparedScene {
    Scene scene;
    // Power of two that makes one film unit: radiance / unit is what the film sums. It puts the brightest emission into
    // [2^7, 2^8) units, so that samples 2^20 times as bright are still accepted and samples 2^-44 times as bright are
    // exact, whatever the scene's unit of light is.
    double film_unit;
    std::vector<Material> used_materials;    // those that some surface has, in the scene's order
    std::vector<std::uint32_t> used_indices; // where in used_materials those of the scene are, if they are
    bool gloss;                              // some material in use has a specular lobe
    bool moves;                              // some sphere does
    std::shared_ptr<const SphereTree> tree;  // most spheres, if there are many; else NULL
    std::vector<std::uint32_t> sphere_order; // of those that are not in the tree, along the line of twins.h

    // From a number of spheres on most of them are put into a tree.
    explicit PreparedScene(Scene of, std::uint32_t tree_from = no_tree);

    static constexpr std::uint32_t no_tree = UINT32_MAX;

    // The scene without the spheres that are in the tree.
    const Scene &without_tree() const { return rest_ ? *rest_ : scene; }

    // Of the scene (scene_digest.h). Computed when it is first asked for, and kept: most scenes are never in a film.
    const std::string &digest() const;

private:
    void plant_tree();

    std::optional<Scene> rest_;  // if there is a tree
    mutable std::string digest_; // empty: not yet
};

} // namespace pt
