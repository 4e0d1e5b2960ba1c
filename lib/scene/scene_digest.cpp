// Tells scenes apart by what is in them; see scene_digest.h.
#include "lib/scene/scene_digest.h"

#include "lib/scene/distinct_materials.h"

#include <vector>

namespace pt {

namespace {

// Adds the material of each surface as a number. When a number occurs for the first time, the whole material follows
// it.
class MaterialDigest {
public:
    MaterialDigest(Digest &digest, const std::vector<Material> &materials) :
        digest_(digest),
        materials_(materials),
        distinct_(materials),
        numbers_(materials.size(), unknown) {}

    void add(std::uint32_t material) {
        const bool is_first = numbers_[material] == unknown && number(material);
        digest_.add(std::uint64_t{numbers_[material]});
        if (is_first)
            pt::add(digest_, materials_[material]);
    }

private:
    static constexpr std::uint32_t unknown = ~std::uint32_t{0};

    // Adds the number of a material; returns whether it is new, that is, no equal material came before.
    bool number(std::uint32_t index) {
        const std::uint32_t first = distinct_.first_equal(index);
        numbers_[index] = first == index ? met_++ : numbers_[first];
        return first == index;
    }

    Digest &digest_;
    const std::vector<Material> &materials_;
    DistinctMaterials distinct_;
    std::vector<std::uint32_t> numbers_; // in the order in which they are met; equal ones have one number
    std::uint32_t met_ = 0;
};

} // namespace

void add(Digest &digest, const Material &material) {
    digest.add(material.diffuse);
    digest.add(material.specular);
    digest.add(material.emission);
    digest.add(static_cast<double>(material.glossiness));
    if (material.hidden) // so that scenes without such keep the digest that their films have
        digest.add(std::uint64_t{PT_MATERIAL_HIDDEN_FROM_CAMERA});
}

std::string digest_of(const Scene &scene) {
    Digest digest;
    MaterialDigest materials(digest, scene.materials);
    for (const std::size_t count : {scene.spheres.size(), scene.planes.size()})
        digest.add(std::uint64_t{count});
    for (const Sphere &sphere : scene.spheres) {
        digest.add(sphere.center);
        digest.add(sphere.radius);
        digest.add(sphere.motion);
        if (sphere.swept) // so that scenes without capsules keep the digest that their films have
            digest.add(std::uint64_t{sphere.swept});
        materials.add(sphere.material);
    }
    for (const Plane &plane : scene.planes) {
        digest.add(plane.normal);
        digest.add(plane.offset);
        materials.add(plane.material);
    }
    return digest.text();
}

} // namespace pt
