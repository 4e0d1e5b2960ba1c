// A camera that obeys the rules of pt.h, with defaults applied.
#pragma once

#include <pt/pt.h>

#include <glm/glm.hpp>

namespace pt {

struct Camera {
    glm::dvec3 position; // where camera rays start: the pinhole, or a point ahead of it
    glm::dvec3 right;    // unit vectors, each perpendicular to the others; right x up points backwards
    glm::dvec3 up;
    glm::dvec3 forward;
    double tan_half_fov; // of the vertical field of view
    double shutter_open; // 0 <= open <= close <= 1
    double shutter_close;
    double start_distance = 0.0; // of position from the pinhole, along forward (ray_start.h)
};

// Takes over a camera whose struct_size is settled. Throws PT_ERROR_INVALID_ARGUMENT with all broken rules.
Camera validated_camera(const pt_camera &source);

} // namespace pt
