#pragma once

#include "lib/base/digest.h"
#include "lib/scene/material.h"
#include "lib/scene/moving_ball.h"
#include "shaders/gpu_layout.h"

#include <pt/pt.h>

#include <glm/glm.hpp>

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

namespace pt {

// Opacities are in steps of 1 / TREE_OPACITY_STEPS. If all spheres of a scene are opaque, all have no_opacity.
inline constexpr std::int16_t no_opacity = -1;
inline constexpr auto opaque = static_cast<std::int16_t>(gpu::TREE_OPACITY_STEPS);
inline constexpr double least_opaque = 1.0 - 0.5 / gpu::TREE_OPACITY_STEPS;

template <typename Real>
std::int16_t opacity_steps(Real opacity) {
    return static_cast<std::int16_t>(std::lround(opacity * opaque));
}

inline double passing_share(std::int16_t opacity) {
    return opacity == no_opacity ? 0.0 : 1.0 - static_cast<double>(opacity) / gpu::TREE_OPACITY_STEPS;
}

struct Sphere {
    glm::dvec3 center;
    double radius;
    glm::dvec3 motion; // displacement from time 0 to 1; for capsules from end to end
    std::uint32_t material;
    Kind kind = Kind::ball;
    std::int16_t opacity = no_opacity;
    Look look{};

    void make_capsule(const glm::dvec3 &end) {
        kind = Kind::capsule;
        motion = end - center;
    }

    bool is_translucent() const { return opacity != no_opacity && opacity < opaque; }

    MovingBall ball() const { return {center, motion, radius, kind}; }
};

struct Plane {
    glm::dvec3 normal; // unit vector; dot(normal, x) + offset = 0
    double offset;
    std::uint32_t material;
};

struct Scene {
    std::vector<Material> materials; // the caller's, then materials of colored spheres
    std::vector<Sphere> spheres;     // pt_scene.spheres, then the arrays
    std::vector<Plane> planes;
    std::vector<std::uint32_t> array_starts = {};
    std::vector<std::uint32_t> indices = {}; // indices in the caller's scene; empty if all spheres are kept
};

struct CheckedScene;

// Takes all spheres, or only those with the indices `only`, which must ascend.
Scene owned_scene(CheckedScene checked, const std::vector<std::uint32_t> *only = nullptr);

// The place of a sphere in messages.
struct SpherePlace {
    const char *subject;
    std::int64_t index;
    std::int32_t component;
};

SpherePlace place_of_sphere(const Scene &scene, std::size_t position);

SpherePlace place_of_index(const Scene &scene, std::size_t index);

// Films identify a scene by this digest. It depends on the order of surfaces, but not on unused materials or on the
// order and repetition of materials.
std::string digest_of(const Scene &scene);

void add(Digest &digest, const Material &material);

} // namespace pt
