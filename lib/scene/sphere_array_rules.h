// The rules of pt_scene.sphere_arrays, one line each.
#pragma once

#include "lib/base/rules.h"
#include "lib/base/work_progress.h"

#include <pt/pt.h>

#include <cstdint>
#include <span>
#include <string>
#include <vector>

namespace pt {

// The limit for all arrays together, for which indices of spheres and the memory of a scene are designed.
constexpr std::uint64_t max_sphere_count = std::uint64_t{1} << 26;

// The arrays as structs of this version of the library, if their number is possible at all. Throws
// PT_ERROR_INVALID_ARGUMENT or PT_ERROR_UNSUPPORTED for a bad struct_size.
std::vector<pt_sphere_array> copied_sphere_arrays(const pt_scene &scene, Violations &violations);

// At most how many elements of columns have to be looked at.
double elements_of(std::span<const pt_sphere_array> arrays);

// Checks the columns and their contents; each element is a unit of work. If the columns of an array cannot be read,
// nothing else of that array is checked.
void check_sphere_arrays(std::span<const pt_sphere_array> arrays, std::span<const pt_material> materials,
                         Violations &violations, WorkProgress &progress);

// "must be < material_count (5)"
std::string material_rule(std::uint32_t material_count);

} // namespace pt
