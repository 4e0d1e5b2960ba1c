// The field of pt_camera that has the size of the view, by projection. Rules of the camera and of scene files follow
// from this list.
#pragma once

#include <pt/pt.h>

#include <cmath>
#include <numbers>

namespace pt {

struct ViewSize {
    const char *article;
    const char *projection;
    const char *member;
    double pt_camera::*value; // 0 with other projections
    double initial;           // 0: none
    double least;
    double largest;
    bool excludes_largest;
    const char *range_rule;

    const char *broken_rule(double number) const {
        if (!std::isfinite(number))
            return "must be finite";
        return number >= least && number <= largest && !(excludes_largest && number == largest) ? nullptr : range_rule;
    }
};

// Indexed by PT_PROJECTION_*. The image plane's distance in pixels, height / (2 tan(fov / 2)), must be at most 1e18, so
// tan(fov / 2) >= 2^31 / 1e18 = 2.1e-9. For angles near pi the distance is at least 1e-16 in doubles.
inline constexpr ViewSize view_sizes[] = {
    {"a", "perspective", "vertical_fov", &pt_camera::vertical_fov, std::numbers::pi / 4.0, 1e-8, std::numbers::pi, true,
     "must lie in [1e-8, pi)"},
    {"an", "orthographic", "vertical_extent", &pt_camera::vertical_extent, 0.0, 1e-18, 1e18, false,
     "must lie in [1e-18, 1e18]"},
};

constexpr ViewSize widest_view(double pt_camera::*value) {
    ViewSize widest{};
    for (const ViewSize &size : view_sizes)
        if (size.value == value && size.largest > widest.largest)
            widest = size;
    return widest;
}

} // namespace pt
