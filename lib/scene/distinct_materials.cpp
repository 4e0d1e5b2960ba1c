#include "lib/scene/distinct_materials.h"

#include "lib/base/mixed.h"

#include <algorithm>
#include <bit>
#include <utility>

namespace pt {

namespace {

bool are_equal(const Material &a, const Material &b) {
    return a.diffuse == b.diffuse && a.specular == b.specular && a.emission == b.emission &&
           a.glossiness == b.glossiness && a.hidden == b.hidden;
}

// Equal numbers have equal bits: -0 + 0 = +0.
std::uint64_t bits_of(float value) {
    return std::bit_cast<std::uint32_t>(value + 0.0F);
}

std::uint32_t hash_of(const Material &material) {
    std::uint64_t hash = bits_of(material.glossiness);
    for (const glm::vec3 &color : {material.diffuse, material.specular, material.emission}) {
        hash = mixed(hash ^ (bits_of(color.r) << 32 | bits_of(color.g)));
        hash = mixed(hash ^ bits_of(color.b));
    }
    return static_cast<std::uint32_t>(hash);
}

} // namespace

std::uint32_t DistinctMaterials::first_equal(std::uint32_t index) {
    if (slots_.size() < 2 * (filled_ + 1))
        grow();
    const Material &material = materials_[index];
    const std::uint32_t hash = hash_of(material);
    const std::size_t mask = slots_.size() - 1;
    for (std::size_t i = hash & mask;; i = (i + 1) & mask) {
        Slot &slot = slots_[i];
        if (slot.index == none) {
            slot = {index, hash};
            ++filled_;
            return index;
        }
        if (slot.hash == hash && are_equal(materials_[slot.index], material))
            return slot.index;
    }
}

void DistinctMaterials::grow() {
    const std::vector<Slot> before =
        std::exchange(slots_, std::vector<Slot>(std::max<std::size_t>(16, 2 * slots_.size())));
    const std::size_t mask = slots_.size() - 1;
    for (const Slot &slot : before) {
        if (slot.index == none)
            continue;
        std::size_t i = slot.hash & mask;
        while (slots_[i].index != none)
            i = (i + 1) & mask;
        slots_[i] = slot;
    }
}

} // namespace pt
