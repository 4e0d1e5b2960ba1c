#pragma once

#include "lib/base/work_progress.h"
#include "lib/scene/material.h"
#include "shaders/gpu_layout.h"

#include <array>
#include <cstdint>
#include <functional>
#include <vector>

namespace pt {

// The bounding ball of a sphere and its whole motion, in any unit.
struct TreeItem {
    std::array<float, 4> center_radius;
    std::uint32_t sphere;
};

inline constexpr std::uint32_t tree_width = gpu::TREE_WIDTH;

// Child nodes come before child spheres.
struct TreeLinks {
    std::uint32_t first_child;
    std::uint32_t first_place;
    std::uint8_t inner_count;
    std::uint8_t child_count;
};

struct TreeShape {
    std::vector<TreeLinks> nodes; // the root first, each node before its children
    std::vector<std::uint32_t> spheres;
    std::uint32_t depth;
};

// A sphere's geometry and, if it is translucent, material and looks. Spheres with equal bits are twins, of which only
// the first is kept.
using SphereBits = std::array<std::uint32_t, 9 + look_columns.size()>;
using BitsOfSphere = std::function<SphereBits(std::uint32_t)>;

// Cuts nodes where the sum of surface * expected nodes is least (Goldsmith and Salmon 1987; Wald 2007). Deep nodes are
// cut into equal halves, so the depth is at most 27 for 2^26 spheres. Each item is a unit of work.
TreeShape tree_shape(std::vector<TreeItem> items, const BitsOfSphere &bits_of, WorkProgress &progress);

} // namespace pt
