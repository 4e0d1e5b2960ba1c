// Materials that are told apart by what they are. Used for the colors of spheres, and for digests.
#pragma once

#include "lib/scene/scene.h"

#include <cstddef>
#include <cstdint>
#include <vector>

namespace pt {

// A hash table of indices: 16 to 32 bytes a material.
class DistinctMaterials {
public:
    // Of none at first. The materials may grow, but what was looked at stays as it is.
    explicit DistinctMaterials(const std::vector<Material> &materials) : materials_(materials) {}

    // The index of the first that was looked at and equals materials[index]: its own, if it is the first.
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
