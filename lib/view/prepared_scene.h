// The parts of a scene that do not depend on the camera.
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
    Scene scene; // without spheres of the tree
    // Radiance per film unit, a power of two (shaders/README.md, section 11).
    double film_unit;
    std::vector<Material> used_materials;
    std::vector<std::uint32_t> used_indices; // index into used_materials of each scene material
    bool gloss;
    std::shared_ptr<const SphereTree> tree; // NULL for few spheres
    bool moves;
    std::vector<std::uint32_t> lamp_order; // result of order_in_lamp_tree()

    explicit PreparedScene(Scene of);

    // Makes a tree if there are at least tree_from visible spheres or, without tree_from, if a tree is faster. Reuses
    // the tree shape of `before` (may be NULL) if it fits.
    PreparedScene(CheckedScene checked, std::optional<std::uint32_t> tree_from, const PreparedScene *before,
                  WorkProgress &progress);

    const std::string &digest() const;

private:
    static PreparedScene prepared(CheckedScene checked, std::optional<std::uint32_t> wanted, const SphereTree *before,
                                  WorkProgress &progress);

    static PreparedScene with_tree(const CheckedScene &checked, const TreeChoice &choice, const SphereTree *before,
                                   WorkProgress &progress);

    void note_materials(const std::vector<bool> &used);

    mutable std::string digest_;
};

} // namespace pt
