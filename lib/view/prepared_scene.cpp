#include "lib/view/prepared_scene.h"

#include "lib/tree/tree_choice.h"
#include "lib/view/lamp_tree.h"

#include <algorithm>
#include <cmath>
#include <iterator>
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

// Fractions of the remaining work, for progress.enter().
constexpr double share_of_hidden = 0.05;
constexpr double share_of_outlying = 0.05;
constexpr double share_of_materials = 0.02;

std::vector<std::uint32_t> hidden_spheres(const CheckedScene &checked, WorkProgress &progress) {
    std::vector<std::uint32_t> hidden;
    if (std::ranges::none_of(checked.materials, &Material::hidden))
        return hidden;
    progress.enter(share_of_hidden, static_cast<double>(checked.spheres.size()));
    checked.spheres.for_each(progress, [&](std::size_t i, const Sphere &sphere, const glm::vec3 &) {
        if (checked.materials[sphere.material].hidden)
            hidden.push_back(static_cast<std::uint32_t>(i));
    });
    return hidden;
}

// Hidden spheres stay outside the tree, because camera rays do not check materials of tree spheres.
std::vector<std::uint32_t> left_out_of(const CheckedScene &checked, const std::vector<std::uint32_t> &hidden,
                                       WorkProgress &progress) {
    progress.enter(share_of_outlying, static_cast<double>(checked.spheres.size()));
    std::vector<std::uint32_t> left_out;
    std::ranges::set_union(hidden, spheres_beside_tree(checked.spheres, progress), std::back_inserter(left_out));
    return left_out;
}

std::shared_ptr<const SphereTree> tree_over(const SphereSource &spheres, const std::vector<std::uint32_t> &left_out,
                                            const std::vector<TreeMaterial> &materials, const SphereTree *before,
                                            WorkProgress &progress) {
    if (before != nullptr)
        if (auto kept = SphereTree::with_shape_of(*before, spheres, left_out, materials, progress))
            return std::make_shared<const SphereTree>(std::move(*kept));
    return std::make_shared<const SphereTree>(spheres, left_out, materials, progress);
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

PreparedScene PreparedScene::prepared(CheckedScene checked, std::optional<std::uint32_t> tree_from,
                                      const SphereTree *before, WorkProgress &progress) {
    const std::uint32_t from =
        checked.spheres.has_opacities() ? 1 : tree_from.value_or(tree_pays_from(checked.spheres));
    if (checked.spheres.size() >= from) {
        const std::vector<std::uint32_t> hidden = hidden_spheres(checked, progress);
        if (checked.spheres.size() - hidden.size() >= from) {
            const std::vector<std::uint32_t> left_out = left_out_of(checked, hidden, progress);
            if (left_out.size() < checked.spheres.size())
                return with_tree(checked, left_out, before, progress);
        }
    }
    return PreparedScene(owned_scene(std::move(checked)));
}

PreparedScene PreparedScene::with_tree(const CheckedScene &checked, const std::vector<std::uint32_t> &left_out,
                                       const SphereTree *before, WorkProgress &progress) {
    PreparedScene prepared(owned_scene(checked, &left_out));
    std::vector<bool> used = is_used(prepared.scene);
    progress.enter(share_of_materials, static_cast<double>(checked.spheres.size()));
    checked.spheres.mark_materials(used, progress);
    prepared.note_materials(used);
    std::vector<TreeMaterial> materials;
    for (std::size_t i = 0; i < used.size(); ++i)
        materials.push_back({prepared.used_indices[i], emits(prepared.scene.materials[i])});
    prepared.tree = tree_over(checked.spheres, left_out, materials, before, progress);
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
