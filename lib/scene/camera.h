#pragma once

#include <pt/pt.h>

#include <glm/glm.hpp>

#include <cmath>
#include <cstdint>

namespace pt {

struct Camera {
    glm::dvec3 position;
    glm::dvec3 right; // right, up and forward are orthonormal; right x up = -forward
    glm::dvec3 up;
    glm::dvec3 forward;
    double view_size;    // perspective: tangent of half the vertical angle; orthographic: the view's height
    double shutter_open; // 0 <= shutter_open <= shutter_close <= 1
    double shutter_close;
    double start_distance = 0.0; // distance of ray starts from pt_camera.position (lib/view/projection.h)
    double start_radius = 0.0;   // radius of the disc where rays start; 0 for a point
    double lens_radius = 0.0;    // 0 without a lens
    double focus = 0.0;          // depth of the plane in focus
    std::uint32_t projection = PT_PROJECTION_PERSPECTIVE;

    bool is_orthographic() const { return projection == PT_PROJECTION_ORTHOGRAPHIC; }
    bool has_lens() const { return lens_radius > 0.0; }

    // Returns the radius of the disc that the rays of an image point fill at this depth.
    double spread(double depth) const { return has_lens() ? lens_radius * std::abs(1.0 - depth / focus) : 0.0; }
};

} // namespace pt
