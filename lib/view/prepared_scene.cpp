#include "lib/view/prepared_scene.h"

#include "lib/tree/tree_choice.h"
#include "lib/view/lamp_tree.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace pt {

namespace {

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
    int exponent = 0;
    std::frexp(brightest, &exponent);
    // 1 / unit must be a normal float32.
    return std::ldexp(1.0, std::clamp(exponent - 8, -120, 120));
}

Scene with_lamps(Scene scene, const SphereTree &tree) {
    for (std::uint32_t lamp = 0; lamp < tree.lamp_materials().size(); ++lamp)
        scene.spheres.push_back(tree.lamp(lamp));
    return scene;
}

// The digest leaves out the tree's shape, which depends on earlier scenes.
std::string digest_with_tree(const PreparedScene &prepared) {
    Digest digest;
    digest.add(digest_of(prepared.scene));
    prepared.tree->add_to(digest);
    for (const Material &material : prepared.used_materials)
        add(digest, material);
    return digest.text();
}

std::shared_ptr<const SphereTree> tree_over(const SphereSource &spheres, const TreeChoice &choice,
                                            const std::vector<TreeMaterial> &materials, const SphereTree *before,
                                            WorkProgress &progress) {
    if (before != nullptr)
        if (auto kept = SphereTree::with_shape_of(*before, spheres, choice, materials, progress))
            return std::make_shared<const SphereTree>(std::move(*kept));
    return std::make_shared<const SphereTree>(spheres, choice, materials, progress);
}

} // namespace

PreparedScene::PreparedScene(Scene of) :
    scene(std::move(of)),
    moves(std::ranges::any_of(scene.spheres, [](const Sphere &sphere) { return sphere.ball().moves(); })),
    lamp_order(order_in_lamp_tree(scene)) {
    note_materials(is_used(scene));
}

PreparedScene::PreparedScene(CheckedScene checked, std::optional<std::uint32_t> tree_from, const PreparedScene *before,
                             WorkProgress &progress) :
    PreparedScene(prepared(std::move(checked), tree_from, before ? before->tree.get() : nullptr, progress)) {}

PreparedScene PreparedScene::prepared(CheckedScene checked, std::optional<std::uint32_t> wanted,
                                      const SphereTree *before, WorkProgress &progress) {
    const std::uint32_t from = tree_from(checked.spheres.counts(), wanted);
    if (checked.spheres.size() >= from) {
        const TreeChoice choice = tree_choice(checked.spheres, checked.materials, progress);
        if (checked.spheres.size() - choice.hidden_count >= from && choice.left_out.size() < checked.spheres.size())
            return with_tree(checked, choice, before, progress);
    }
    return PreparedScene(owned_scene(std::move(checked)));
}

PreparedScene PreparedScene::with_tree(const CheckedScene &checked, const TreeChoice &choice, const SphereTree *before,
                                       WorkProgress &progress) {
    PreparedScene prepared(owned_scene(checked, &choice.left_out));
    std::vector<bool> used = is_used(prepared.scene);
    for (std::size_t i = 0; i < choice.used_materials.size(); ++i)
        used[i] = used[i] || choice.used_materials[i];
    prepared.note_materials(used);
    std::vector<TreeMaterial> materials;
    for (std::size_t i = 0; i < used.size(); ++i)
        materials.push_back({prepared.used_indices[i], emits(prepared.scene.materials[i])});
    prepared.tree = tree_over(checked.spheres, choice, materials, before, progress);
    prepared.moves = prepared.moves || prepared.tree->moves();
    prepared.lamp_order = order_in_lamp_tree(with_lamps(prepared.scene, *prepared.tree));
    return prepared;
}

void PreparedScene::note_materials(const std::vector<bool> &used) {
    used_materials.clear();
    used_indices.clear();
    for (std::size_t i = 0; i < used.size(); ++i) {
        used_indices.push_back(static_cast<std::uint32_t>(used_materials.size()));
        if (used[i])
            used_materials.push_back(scene.materials[i]);
    }
    film_unit = pt::film_unit(used_materials);
    gloss = std::ranges::any_of(used_materials, is_glossy);
}

const std::string &PreparedScene::digest() const {
    if (digest_.empty())
        digest_ = tree ? digest_with_tree(*this) : digest_of(scene);
    return digest_;
}

} // namespace pt
