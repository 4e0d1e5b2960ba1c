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

// Of all arrays together: what the spheres' indices and the memory of a scene are made for.
constexpr std::uint64_t max_sphere_count = std::uint64_t{1} << 26;

// The elements as this library knows them, if there can be so many. Throws PT_ERROR_INVALID_ARGUMENT or
// PT_ERROR_UNSUPPORTED if their sizes are not those of a struct.
std::vector<pt_sphere_array> copied_sphere_arrays(const pt_scene &scene, Violations &violations);

// Elements of columns that are to be looked at, at the most.
double elements_of(std::span<const pt_sphere_array> arrays);

// Checks columns and what is in them: each element is a unit of work. Of an array whose columns cannot be read nothing
// else is checked.
void check_sphere_arrays(std::span<const pt_sphere_array> arrays, std::uint32_t material_count, Violations &violations,
                         WorkProgress &progress);

// "must be < material_count (5)"
std::string material_rule(std::uint32_t material_count);

} // namespace pt
