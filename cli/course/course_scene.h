// Scenes of the course's checks, with exact values for right kernels and for wrong ones.
#pragma once

#include "cli/course/verdict.h"

#include <array>
#include <functional>
#include <glm/glm.hpp>
#include <span>
#include <vector>

namespace cli {

// Five far lamps above a tilted floor, seen by parallel rays. The red lamp lies along the normal. Two green lamps are
// beside it, opposite two blue ones.
SceneFile lamps_above_a_floor(std::uint32_t side, std::uint32_t sample_count);

using Channels = std::array<double, 3>;

// Turns a uniform direction into the kernel's.
using Turn = std::function<glm::dvec3(const glm::dvec3 &direction, const glm::dvec3 &normal)>;
// Weight of a direction with this cosine to the normal; 0 below the surface.
using Weight = std::function<double(double cosine)>;

glm::dvec3 to_the_normals_side(const glm::dvec3 &direction, const glm::dvec3 &normal);
glm::dvec3 absolute_z(const glm::dvec3 &direction, const glm::dvec3 &normal);
glm::dvec3 unturned(const glm::dvec3 &direction, const glm::dvec3 &normal);

// Means of the picture, by quadrature over the sphere.
Channels lamplight(const Turn &turn, const Weight &weight);

// The camera looks at a glossy floor from a green lamp. A mirror would show a blue lamp.
SceneFile lamps_above_a_glossy_floor();

// Its means, if lobes are about axis_of(ray, normal).
Channels gloss_of_lamps(const Turn &axis_of);
glm::dvec3 mirrored(const glm::dvec3 &ray, const glm::dvec3 &normal);
glm::dvec3 turned_back(const glm::dvec3 &ray, const glm::dvec3 &normal);
glm::dvec3 along_normal(const glm::dvec3 &ray, const glm::dvec3 &normal);

inline constexpr double lamp_count = 5.0;
Channels lamp_solid_angles();

// Exact values by form factors of spheres above a plane (Snyder 1996).
Channels right_lamplight();

// The sky and a tiny lamp are yellow. The tilted floor reflects red diffusely and green in a lobe, and alone emits
// blue, 1. Each pixel has one sample.
SceneFile floor_under_the_sky();
inline constexpr double floor_glossiness = 8.0;

// A red lamp above a floor that emits blue, 1. The library starts rays of narrower pixels near the floor.
SceneFile floor_below_a_lamp();
inline constexpr double near_lamp_square_sine = 0.390625; // of half its cone's angle

// Radiance in selftest's lamp_in_a_ball(). Directions to the lamp have the weight `hit`, others the weight `missed`.
double light_in_a_ball(double hit, double missed, int vertices = 3);
double ball_cosine(); // of half the cone's angle

// A ball of emission 1 that reflects half, seen from its inside.
SceneFile glowing_ball(std::uint32_t max_path_length);

// A floor in the full shadow of a ball.
SceneFile shadow();

// A lamp seen by parallel rays, 32 pixels wide.
SceneFile disc(bool moves);
inline constexpr double disc_radius = 10.3; // pixels
inline constexpr Channels disc_emission{4.0, 0.5, 0.1};

// Holds at the picture's middle.
double disc_cosine();

// A moving blue ball hides a floor from the camera, then a red lamp from the floor. The sky is green.
SceneFile ball_before_camera_and_lamp();

// It reflects a white sky, and is in the middle of the view at all times.
SceneFile moving_ball_under_the_sky();

struct FloorLight {
    Channels right;
    Channels reflected_at_0; // time 0 after the camera's ray
    Channels reflected_at_any_time;
};

FloorLight light_below_the_ball();

struct DiscSample {
    glm::dvec2 place;
    double time;
};

// Place of the disc, softness and slant of its edge, and spread along its motion.
std::vector<Measured> disc_values(std::span<const double> coverage, double bound_factor);
std::vector<Measured> disc_values(const Picture &picture);
std::vector<Range> disc_values(bool moves, const std::vector<DiscSample> &samples);

// A file in cli/scenes, with 64x32 pixels.
SceneFile course_scene(const std::string &name, std::uint32_t sample_count, std::uint32_t max_path_length,
                       std::uint32_t estimator);

} // namespace cli
