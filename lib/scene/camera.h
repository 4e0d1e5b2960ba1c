// A camera that obeys the rules of pt.h, with defaults applied.
#pragma once

#include <pt/pt.h>

#include <glm/glm.hpp>

#include <cmath>
#include <string>

namespace pt {

struct Camera {
    glm::dvec3 position; // where the ray in the middle of the image starts: the pinhole, or a point ahead of it
    glm::dvec3 right;    // unit vectors, each perpendicular to the others; right x up points backwards
    glm::dvec3 up;
    glm::dvec3 forward;
    double tan_half_fov; // of the vertical field of view; 0: rays are parallel
    double shutter_open; // 0 <= open <= close <= 1
    double shutter_close;
    double vertical_extent = 0.0; // of the view of parallel rays; 0: they start at the pinhole
    double start_distance = 0.0;  // from pt_camera.position to this position, along forward (ray_start.h)
    double start_radius = 0.0;    // rays start on a disc of this radius about position; 0: a pinhole (ray_start.h)
    double lens_radius = 0.0;     // 0: a pinhole, or parallel rays
    double focus = 0.0;           // distance of the plane in focus from the lens, along forward; 0 without a lens

    bool is_orthographic() const { return vertical_extent > 0.0; }
    bool has_lens() const { return lens_radius > 0.0; }

    // Radius of the disc that the rays of a place in the image fill at a depth from the lens: they meet on the plane in
    // focus.
    double spread(double depth) const { return has_lens() ? lens_radius * std::abs(1.0 - depth / focus) : 0.0; }
};

// Takes over a camera whose struct_size is settled. Throws PT_ERROR_INVALID_ARGUMENT with all broken rules.
Camera validated_camera(const pt_camera &source);

// A digest of the camera, by which films tell cameras apart.
std::string digest_of(const Camera &camera);

} // namespace pt
