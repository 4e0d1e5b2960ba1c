// How contexts are made. The same tests make two programs: one makes contexts like any program, the other puts spheres
// into a tree however few there are.
#pragma once

#include <pt/pt.h>

#include <cstdint>

namespace analytic {

pt_result create(const pt_create_info *info, pt_context **context);

// Whether every scene with a sphere has a tree.
extern const bool always_tree;

// Walks through a tree take longer, so fewer samples are taken: where the other program takes so many, one. A power of
// two.
extern const std::uint32_t samples_for_one;

} // namespace analytic
