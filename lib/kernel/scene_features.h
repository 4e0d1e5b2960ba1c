// What a scene needs of the kernel: everything else is left out of it. Found by gpu_scene;
// TracePipelines specialises pathtrace.comp with it.
#pragma once

#include "lib/kernel/kernel_surfaces.h"
#include "lib/kernel/point_sequence.h"
#include "lib/kernel/prepared_scene.h"
#include "lib/scene/camera.h"
#include "lib/scene/render_settings.h"
#include "lib/scene/twins.h"
#include "shaders/specialization.h"

#include <array>
#include <cstdint>
#include <vector>

namespace pt {

struct Features {
    // Values of the specialization constants, by gpu::ID_*, as far as a scene, its camera and settings tell them.
    std::array<std::uint32_t, gpu::CONSTANT_COUNT> constants{};
    std::uint32_t most_branches = 0;   // of a path at its first vertex, by the number of spheres
    std::uint32_t table_materials = 0; // that the surfaces share if the scene is not in the uniform buffer

    bool operator==(const Features &) const = default;

    std::uint32_t &operator[](std::uint32_t id) { return constants[id]; }
    std::uint32_t operator[](std::uint32_t id) const { return constants[id]; }

    // Whether the scene, with the words of a material for each surface, fits into a uniform buffer.
    bool scene_in_uniform() const { return constants[gpu::ID_SCENE_SOURCE] == gpu::SCENE_IN_UNIFORM; }
    // Whether the scene buffer has the ways of spheres.
    bool has_ways() const { return constants[gpu::ID_MOTION] > 0 || constants[gpu::ID_KINDS] > gpu::KIND_BALL; }
    std::uint32_t surface_count() const { return constants[gpu::ID_SPHERE_COUNT] + constants[gpu::ID_PLANE_COUNT]; }
    std::uint32_t emitting_spheres() const { return constants[gpu::ID_LAMP_COUNT] + constants[gpu::ID_SKY_COUNT]; }
    std::uint32_t walked_lamps() const { return constants[gpu::ID_LAMP_COUNT] - constants[gpu::ID_TREE_LAMPS]; }
};

// All features but gpu::ID_SPOT_COUNT (light_spots.h).
Features features_of(const DistinctScene &distinct, const KernelSurfaces &surfaces, const PreparedScene &scene,
                     const Camera &camera, const RenderSettings &render);

// Whether the estimator samples lamps and paths are long enough for it.
bool samples_lamps(const Features &features);

// How many numbers each of the blocks of a camera ray has.
std::vector<std::uint32_t> camera_blocks(const Features &features);

// Branches in which a path leaves its first vertex. Where light comes over several vertices, so does most of the noise,
// and the camera ray, its vertex and the lamps seen from it serve all branches. (Measured on the coursework scene with
// six vertices, 4 branches against 1: a fourth to a fifth of the error in 2.9 times the time.) The more spheres there
// are, the more of them a pixel sees, so that more of the noise comes from the camera ray, and the less of the work is
// rays that branches share: then there are 2 branches or 1. There are 2 where rays by way of spots find most of what
// comes over three vertices, and paths have no more. Where scene and path are so long that a sample is a long job by
// itself, they do not branch: some drivers stop a kernel after 65535 loop trips.
std::uint32_t branch_count(const Features &features);

// What the point table holds for each sample: the dimensions that its paths consume, as far as the sequences have them;
// nothing for samplers without a sequence.
PointLayout point_layout(const Features &features);

// Values of all specialization constants, by constant_id.
std::array<std::uint32_t, gpu::CONSTANT_COUNT> specialization_constants(const Features &features);

// An upper bound of the loop trips that one sample takes, with no loop unrolled.
std::uint64_t loop_trips_per_sample(const Features &features);

// The same for one walk over the surfaces, with one ray or with two that leave the same vertex.
std::uint64_t loop_trips_per_walk(const Features &features);

// How many tests of a ray against a surface a path of full length takes: its cost, to within a small factor. tree: NULL
// if there is none.
double surface_tests_per_path(const Features &features, const SphereTree *tree);

// The same for a single ray. tree: likewise.
double surface_tests_per_ray(const Features &features, const SphereTree *tree);

// The features as PT_FEATURE_* bits.
std::uint32_t feature_bits(const Features &features);

} // namespace pt
