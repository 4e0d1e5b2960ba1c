#pragma once

#include "lib/base/rules.h"
#include "lib/base/work_progress.h"

#include <pt/pt.h>

#include <cstdint>
#include <span>
#include <string>
#include <vector>

namespace pt {

// The largest number of spheres in a scene.
constexpr std::uint64_t max_sphere_count = std::uint64_t{1} << 26;

// Throws PT_ERROR_INVALID_ARGUMENT or PT_ERROR_UNSUPPORTED for a wrong struct_size.
std::vector<pt_sphere_array> copied_sphere_arrays(const pt_scene &scene, Violations &violations);

double elements_of(std::span<const pt_sphere_array> arrays);

// Each element is a unit of work. Columns that cannot be read are skipped.
void check_sphere_arrays(std::span<const pt_sphere_array> arrays, std::span<const pt_material> materials,
                         Violations &violations, WorkProgress &progress);

std::string material_rule(std::uint32_t material_count);

} // namespace pt
