#pragma once

#include "tests/fuzz/numbers.h"
#include "tests/support/scene_of.h"

#include <vector>

namespace fuzz {

struct Input {
    std::vector<pt_material> materials;
    std::vector<pt_sphere> spheres;
    std::vector<pt_plane> planes;
    pt_camera camera = sized<pt_camera>();
    pt_render render = sized<pt_render>();
    std::uint32_t sample_count = 1;
    std::uint32_t column_count = 0; // The last spheres are read from columns, which point into their structs.
    bool has_colors = false;
    mutable pt_sphere_array columns{};

    // Points into the input.
    pt_scene scene() const;
};

Input decoded_input(Numbers numbers);

// Each examine_*.cpp defines this. A failed check ends the process.
void examine(const Input &input, std::span<const std::uint8_t> bytes);

} // namespace fuzz
