#pragma once

#include "lib/view/seen_scene.h"

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

constexpr Real rounding = 0x1p-24L; // float32's unit roundoff
constexpr Real nowhere = std::numeric_limits<Real>::infinity();

inline Vector vector_of(const double (&v)[3]) {
    return {v[0], v[1], v[2]};
}

struct Ray {
    Vector direction;
    Real time;
    Vector start;
    Vector origin{0.0L}; // relative to the camera
    Vector spread{0.0L}; // sizes of the terms that are summed
};

struct Meeting {
    Real distance = nowhere;
    Real tolerance = 0.0L;
    bool is_uncertain = false; // undecided, because the ray almost touches
    Vector normal{0.0L};       // faces the camera
    Real normal_tolerance = 0.0L;
    std::uint32_t object = PT_NO_OBJECT;
};

// All errors are in terms of u, the unit roundoff of float32. A direction has an error of 4 u across (two products and
// sums for each component), and as much in its length.
//
// Let a sphere have center c and radius r. The center has an error of u |c|. Its projection b on the ray has an error
// of 8 u |c|, and so does the ray's distance l from the center. The half chord h = sqrt(r^2 - l^2) has an error of (8 u
// |c| + 2 u r) / cosine with cosine = h / r. The tolerance is twice this error. The difference l - r has an error of 8
// u |c| + 2 u r. Within twice this error it is undecided whether the ray hits.
//
// A flat sphere of curvature k at height h is hit at 2 h / q with q = s + sqrt(s^2 - 2 k h) and slope s. The errors are
// u for h, 4 u for s, and (4 u s + 4 u) / cosine for the root, and q >= cosine. The relative tolerance is 16 u /
// cosine^2 for the root and 8 u for the other terms. If s^2 and 2 k h differ by less than 64 u, it is undecided whether
// the ray hits. The far side is at q / k. A plane has k = 0.
//
// Parallel rays start at origin = a right - b up. The origin has an error of 5 u of the sizes of both terms (scale,
// place, vector, product, sum), in total o. The tolerance is 8 u o for the origin, and as much for the subtraction. A
// height n . origin + offset has an error of 9 u o |n| and 2 u of the offset, so its tolerance is 16 u o / cosine.
//
// In narrow views, |c| and distances are measured from the start of the rays. The grid of a tree displaces centers by
// up to `astray`. If the camera is nearer to a sphere's surface than this, its side is undecided.
inline Meeting meet_sphere(const pt_sphere &sphere, const Vector &camera, const Ray &ray, Real time, bool is_flat,
                           Real astray) {
    const Vector center = vector_of(sphere.center) + time * vector_of(sphere.motion) - camera - ray.origin;
    const Real r = sphere.radius;
    const Real along = glm::dot(center, ray.direction);
    const Real l = glm::length(center - along * ray.direction);
    const Real height = glm::length(center) - r;
    Meeting meeting;
    const Real reach = glm::length(center - ray.start) + glm::length(ray.spread);
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
    meeting.distance = height > 0.0L ? height * (glm::length(center) + r) / (along + half_chord) : along + half_chord;
    const Vector from_center = meeting.distance * ray.direction - center;
    const Vector outward = glm::normalize(from_center);
    const Real cosine = std::max(std::abs(glm::dot(outward, ray.direction)), rounding);
    const Real way = glm::length(meeting.distance * ray.direction - ray.start) + glm::length(ray.spread);
    const Real across = is_flat ? way : reach;
    meeting.tolerance = is_flat ? way * rounding * (8.0L + 16.0L / (cosine * cosine))
                                : rounding * (16.0L * reach + (16.0L * reach + 4.0L * r) / cosine) + astray / cosine;
    meeting.normal = height > 0.0L ? outward : -outward;
    // The error of the point, divided by r, and eight roundings.
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
    Real focal_pixels = 0.0L;
    Real parallel_pixel = 0.0L;
    std::uint32_t width, height;
    Real shutter_open, shutter_close;
    Real start_distance = 0.0L;
    Real tree_step = 0.0L; // step of the spheres' grid

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

// Follows the library's own rule. An emitting sphere becomes a plane only if its radius exceeds 65536 times the
// camera's distance from its surface.
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

// Returns no value if float32 may find another surface, or no surface.
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
