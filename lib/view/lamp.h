#pragma once

#include "lib/scene/camera.h"
#include "lib/scene/moving_ball.h"
#include "lib/scene/scene.h"

#include <glm/glm.hpp>

#include <cstdint>
#include <vector>

namespace pt {

struct PreparedScene;

inline float mean(const glm::vec3 &color) {
    return (color.r + color.g + color.b) / 3.0F;
}

// The lamp tree, small lamps, spots and error estimates use only a lamp's bounding ball.
struct Lamp {
    MovingBall bound; // relative to the camera
    glm::vec3 emission;
    bool hidden = false;
    std::uint32_t number = 0; // in the kernel

    // Proportional to the light that a distant point gets.
    double power() const { return double{mean(emission)} * bound.radius * bound.radius; }
};

inline Lamp lamp_of(const Sphere &sphere, const Material &material, const Camera &camera) {
    return {ball_about(seen_ball(sphere.ball(), camera)), material.emission, material.hidden};
}

// Returns all emitting surfaces that have a bounding ball.
std::vector<Lamp> lamps_of(const PreparedScene &scene, const Camera &camera);

} // namespace pt
