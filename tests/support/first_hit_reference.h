// What rays in a scene of pt.h meet first, by independent formulas in long double, and how far float32 may be off. Used
// by the tests of what camera rays meet first.
#pragma once

#include "lib/scene/seen_scene.h"

#include <pt/pt.h>

#include <glm/glm.hpp>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <optional>
#include <vector>

namespace first_hits {

using Real = long double;
using Vector = glm::vec<3, Real>;

constexpr Real rounding = 0x1p-24L; // of float32
constexpr Real nowhere = std::numeric_limits<Real>::infinity();

inline Vector vector_of(const double (&v)[3]) {
    return {v[0], v[1], v[2]};
}

struct Ray {
    Vector direction; // unit
    Real time;
    Vector start;        // from where float32 computes it, relative to where the ray starts
    Vector origin{0.0L}; // where the ray starts, relative to the camera
    Vector spread{0.0L}; // for each component of origin, the sizes of its two terms
};

// Where a ray meets a surface, and by how much float32 may differ.
struct Meeting {
    Real distance = nowhere;
    Real tolerance = 0.0L;        // of distance
    bool is_uncertain = false;    // the ray nearly touches the surface, or nearly misses it
    Vector normal{0.0L};          // on the side of the camera
    Real normal_tolerance = 0.0L; // of each component
    std::uint32_t object = PT_NO_OBJECT;
};

// Let u be the rounding. A direction is off by 4 u across itself (two products and two sums for each component, and a
// normalisation, of which only what differs between components counts), and its length by 4 u.
//
// A sphere by its centre c, as seen from the camera, and its radius r: the centre is rounded by u |c|, and c - b d errs
// by 4 u |c| for d, and by 3 u |c| for its own operations, so the distance l of the centre from the ray is off by 8 u
// |c|; so is b, the distance along the ray to the point nearest to the centre. The half chord h = sqrt(r^2 - l^2) is
// off by (8 u |c| l + 2 u r^2) / h. With l < r that is (8 u |c| + 2 u r) / cosine for the cosine h / r at the surface.
// Twice that is allowed. The square under the root is off by r (16 u |c| + 4 u r) at most, or l - r by 8 u |c| + 2 u r:
// within twice that of touching, it may be missed or met.
//
// If a sphere is so large, compared with its height h above where rays start, that it is held as a plane with a
// curvature k, nothing of the size of r is rounded: the distance 2 h / q with q = s + sqrt(s^2 - 2 k h) for the slope s
// errs by u for h and by what q errs, which is 4 u for s and (4 u s + 4 u) / cosine for the root, the cosine at the
// surface, and q is no less than that cosine: 16 u / cosine^2 of the distance is allowed, and 8 u for all else; within
// 64 u of touching, as s^2 against 2 k h, it may be missed or met. The far wall from within, q / k, likewise. A plane
// is the same with k = 0.
//
// Parallel rays start all over a disc, by origin = a right - b up, whose components are off by 5 u of the sizes of both
// terms: the rounding of the scale, of the place, of the vector, and of a product, and that of the sum. A centre is
// relative to it by one more subtraction: 8 u of the length o of these sizes is allowed beside 8 u |c|, and as much
// again. A height there, n . origin + offset, is off by 9 u of the sum of |n| times these sizes, o too, for n, origin
// and its own operations, and by 2 u of the offset, which is no more than that and h: 16 u o / cosine is allowed.
//
// In narrow views of what is far away rays start ahead of the camera, and |c| and distances count from there. A tree's
// grid may move a centre by up to astray; which side of the surface the camera is on is then uncertain within that,
// too.
inline Meeting meet_sphere(const pt_sphere &sphere, const Vector &camera, const Ray &ray, Real time, bool is_flat,
                           Real astray) {
    const Vector centre = vector_of(sphere.center) + time * vector_of(sphere.motion) - camera - ray.origin;
    const Real r = sphere.radius;
    const Real along = glm::dot(centre, ray.direction);
    const Real l = glm::length(centre - along * ray.direction);
    const Real height = glm::length(centre) - r;
    Meeting meeting;
    const Real reach = glm::length(centre - ray.start) + glm::length(ray.spread);
    const Real touching = is_flat ? 64.0L * rounding * r : (16.0L * reach + 4.0L * r) * rounding + astray;
    if (height > 0.0L && (along <= 0.0L || l > r)) {
        meeting.is_uncertain = along > 0.0L && l - r < touching;
        if (meeting.is_uncertain)
            meeting.distance = along;
        return meeting;
    }
    meeting.is_uncertain = height > 0.0L && r - l < touching;
    meeting.is_uncertain = meeting.is_uncertain || std::abs(height) < astray;
    const Real half_chord = std::sqrt((r - l) * (r + l));
    // The product of the roots is the power of the camera with respect to the sphere: by it, the nearer root has no
    // cancellation.
    meeting.distance = height > 0.0L ? height * (glm::length(centre) + r) / (along + half_chord) : along + half_chord;
    const Vector from_centre = meeting.distance * ray.direction - centre;
    const Vector outward = glm::normalize(from_centre);
    const Real cosine = std::max(std::abs(glm::dot(outward, ray.direction)), rounding);
    const Real way = glm::length(meeting.distance * ray.direction - ray.start) + glm::length(ray.spread);
    const Real across = is_flat ? way : reach;
    meeting.tolerance = is_flat ? way * rounding * (8.0L + 16.0L / (cosine * cosine))
                                : rounding * (16.0L * reach + (16.0L * reach + 4.0L * r) / cosine) + astray / cosine;
    meeting.normal = height > 0.0L ? outward : -outward;
    // If a point is off by so much, its normal is off by that over r, and by eight roundings of its own.
    meeting.normal_tolerance = (meeting.tolerance + 16.0L * rounding * across) / r + 8.0L * rounding;
    return meeting;
}

inline Meeting meet_plane(const pt_plane &plane, const Vector &camera, const Ray &ray) {
    Meeting meeting;
    const Real length = glm::length(vector_of(plane.normal));
    Vector normal = vector_of(plane.normal) / length;
    Real height = glm::dot(normal, camera + ray.origin) + plane.offset / length;
    normal *= height < 0.0L ? -1.0L : 1.0L;
    height = std::abs(height);
    const Real slope = -glm::dot(normal, ray.direction);
    meeting.is_uncertain = std::abs(slope) < 16.0L * rounding;
    if (slope <= 0.0L)
        return meeting;
    meeting.distance = height / slope;
    const Real way = glm::length(meeting.distance * ray.direction - ray.start) + glm::dot(glm::abs(normal), ray.spread);
    meeting.tolerance = way * rounding * (8.0L + 16.0L / slope);
    meeting.normal = normal;
    meeting.normal_tolerance = 4.0L * rounding;
    return meeting;
}

struct View {
    Vector position, right, up, forward;
    Real focal_pixels = 0.0L;   // distance of the image plane, in pixels
    Real parallel_pixel = 0.0L; // side of a pixel, for parallel rays
    std::uint32_t width, height;
    Real shutter_open, shutter_close;
    Real start_distance = 0.0L;
    Real tree_step = 0.0L; // of the grid that holds the spheres; 0: no tree

    View(const pt_camera &camera, const pt_render &render) :
        position(vector_of(camera.position)),
        forward(glm::normalize(vector_of(camera.target) - position)),
        width(render.width),
        height(render.height),
        shutter_open(camera.shutter_open),
        shutter_close(camera.shutter_close) {
        right = glm::normalize(glm::cross(forward, vector_of(camera.up)));
        up = glm::cross(right, forward);
        if (camera.projection == PT_PROJECTION_ORTHOGRAPHIC)
            parallel_pixel = static_cast<Real>(camera.vertical_extent) / render.height;
        else
            focal_pixels = render.height / (2.0L * std::tan(static_cast<Real>(camera.vertical_fov) / 2.0L));
    }

    // The ray through the place (x, y) in a pixel, at a share of the shutter's time.
    Ray ray(std::uint32_t column, std::uint32_t row, Real x, Real y, Real share) const {
        const Real to_right = column + x - width / 2.0L;
        const Real downwards = row + y - height / 2.0L;
        const Real time = shutter_open + share * (shutter_close - shutter_open);
        if (parallel_pixel > 0.0L)
            return {forward, time, start_distance * forward, parallel_pixel * (to_right * right - downwards * up),
                    parallel_pixel * (glm::abs(to_right * right) + glm::abs(downwards * up))};
        return {.direction = glm::normalize(focal_pixels * forward + to_right * right - downwards * up),
                .time = time,
                .start = start_distance * forward};
    }
};

// Whether the kernel holds a sphere as a plane. This is the library's own rule, since it decides which of two forms is
// rounded. It depends on where rays start; lamps have another rule, and are held by their centres up to a radius of
// 65536 times their height.
inline bool is_held_as_plane(const pt_sphere &sphere, const pt_material &material, const View &view) {
    const auto vector = [](const double(&v)[3]) { return glm::dvec3(v[0], v[1], v[2]); };
    pt::Camera start{};
    start.position = glm::dvec3(view.position + view.start_distance * view.forward);
    start.shutter_open = static_cast<double>(view.shutter_open);
    start.shutter_close = static_cast<double>(view.shutter_close);
    pt::Material seen{};
    seen.emission = {material.emission[0], material.emission[1], material.emission[2]};
    return pt::SeenSphere({vector(sphere.center), sphere.radius, vector(sphere.motion), 0}, seen, start).is_flat;
}

inline bool is_seen(const pt_scene &scene, std::uint32_t material) {
    return scene.materials[material].flags != PT_MATERIAL_HIDDEN_FROM_CAMERA;
}

// The first surface that a ray meets; nothing if float32 may meet another one, or none.
inline std::optional<Meeting> first_met(const pt_scene &scene, const View &view, const Ray &ray) {
    std::vector<Meeting> met;
    for (std::uint32_t i = 0; i < scene.sphere_count; ++i) {
        const pt_sphere &sphere = scene.spheres[i];
        if (!is_seen(scene, sphere.material))
            continue;
        const bool is_flat = view.tree_step == 0.0L && is_held_as_plane(sphere, scene.materials[sphere.material], view);
        const Real astray = view.tree_step + 4.0L * rounding * glm::length(vector_of(sphere.motion));
        met.push_back(meet_sphere(sphere, view.position, ray, ray.time, is_flat, astray));
        met.back().object = i;
    }
    for (std::uint32_t i = 0; i < scene.plane_count; ++i) {
        if (!is_seen(scene, scene.planes[i].material))
            continue;
        met.push_back(meet_plane(scene.planes[i], view.position, ray));
        met.back().object = scene.sphere_count + i;
    }
    Meeting first;
    for (const Meeting &each : met)
        if (!each.is_uncertain && each.distance < first.distance)
            first = each;
    for (const Meeting &each : met)
        if (each.object != first.object &&
            (each.is_uncertain || each.distance - first.distance <= each.tolerance + first.tolerance) &&
            each.distance - each.tolerance <= first.distance + first.tolerance && each.distance < nowhere)
            return std::nullopt;
    return first;
}

} // namespace first_hits
