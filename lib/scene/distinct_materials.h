// Tells materials apart by their values. Used for the colors of spheres, and for digests.
#pragma once

#include "lib/scene/scene.h"

#include <cstddef>
#include <cstdint>
#include <vector>

namespace pt {

// A hash table of indices; it takes 16 to 32 bytes for each material.
class DistinctMaterials {
public:
    // Knows no material at first. More may be appended to the vector later, but those that were looked at must not
    // change.
    explicit DistinctMaterials(const std::vector<Material> &materials) : materials_(materials) {}

    // Among the materials looked at so far, the index of the first that equals materials[index]; index itself if there
    // is none.
    std::uint32_t first_equal(std::uint32_t index);

private:
    static constexpr std::uint32_t none = ~std::uint32_t{0};

    struct Slot {
        std::uint32_t index = none;
        std::uint32_t hash; // of the material, so that others need not be looked at
    };

    void grow();

    const std::vector<Material> &materials_;
    std::vector<Slot> slots_; // a power of two of them, at most half of them filled
    std::size_t filled_ = 0;
};

} // namespace pt
