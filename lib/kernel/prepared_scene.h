// A scene with everything about it that does not depend on the camera. Made once by pt_set_scene, held by Renderer,
// read by gpu_scene.
#pragma once

#include "lib/base/work_progress.h"
#include "lib/scene/checked_scene.h"
#include "lib/scene/scene.h"
#include "lib/tree/sphere_tree.h"

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace pt {

struct PreparedScene {
    Scene scene; // without what is in the tree
    // Power of two that makes one film unit: radiance / unit is what the film sums. It puts the brightest emission into
    // [2^7, 2^8) units, so that samples 2^20 times as bright are still accepted and samples 2^-44 times as bright are
    // exact, whatever the scene's unit of light is.
    double film_unit;
    std::vector<Material> used_materials;    // those that some surface has, in the scene's order
    std::vector<std::uint32_t> used_indices; // where in used_materials those of the scene are, if they are
    bool gloss;                              // some material in use has a specular lobe
    std::shared_ptr<const SphereTree> tree;  // most spheres, if there are many; else NULL
    bool moves;                              // some sphere does
    std::vector<std::uint32_t> lamp_order;   // of the spheres that emit, in the tree of lamp_tree.h

    // Without a tree.
    explicit PreparedScene(Scene of);

    // With a tree if the camera may see at least tree_from spheres, else as many as one pays from; it keeps the shape
    // of the one before, if there was one and it still fits. before may be NULL. Nothing of the caller's memory is read
    // afterwards.
    PreparedScene(CheckedScene checked, std::optional<std::uint32_t> tree_from, const PreparedScene *before,
                  WorkProgress &progress);

    // All spheres that emit, including those in the tree.
    std::vector<Sphere> lamps() const;

    // The digest of the scene (scene.h) and its tree. Computed on first use and kept, since most scenes are
    // never part of a film.
    const std::string &digest() const;

private:
    // before: NULL if there was no tree.
    static PreparedScene prepared(CheckedScene checked, std::optional<std::uint32_t> tree_from,
                                  const SphereTree *before, WorkProgress &progress);

    // left_out: indices of the spheres that are not in the tree.
    static PreparedScene with_tree(const CheckedScene &checked, const std::vector<std::uint32_t> &left_out,
                                   const SphereTree *before, WorkProgress &progress);

    void note_materials(const std::vector<bool> &used);

    mutable std::string digest_; // empty: not yet
};

} // namespace pt
