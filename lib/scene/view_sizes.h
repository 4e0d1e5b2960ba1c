// The field of pt_camera that has the size of the view, by projection. Rules of the camera and of scene files follow
// from this list.
#pragma once

#include <pt/pt.h>

#include <numbers>

namespace pt {

struct ViewSize {
    const char *article;
    const char *projection;
    const char *member;
    double pt_camera::*value; // 0 with other projections
    double initial;           // 0: none
};

// Indexed by PT_PROJECTION_*.
inline constexpr ViewSize view_sizes[] = {
    {"a", "perspective", "vertical_fov", &pt_camera::vertical_fov, std::numbers::pi / 4.0},
    {"an", "orthographic", "vertical_extent", &pt_camera::vertical_extent, 0.0},
};

} // namespace pt
