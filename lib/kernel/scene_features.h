// What a scene needs of the kernel: everything else is left out of it. Found by gpu_scene;
// TracePipelines specialises pathtrace.comp with it.
#pragma once

#include "lib/kernel/kernel_surfaces.h"
#include "lib/kernel/point_sequence.h"
#include "lib/kernel/prepared_scene.h"
#include "lib/scene/camera.h"
#include "lib/scene/render_settings.h"
#include "lib/scene/twins.h"
#include "shaders/gpu_layout.h"

#include <array>
#include <cstdint>
#include <vector>

namespace pt {

struct Features {
    std::uint32_t sphere_count;  // spheres held by centre and radius
    std::uint32_t plane_count;   // planes, and spheres held as planes with a curvature (curved_plane.h)
    std::uint32_t lamp_count;    // emitting ones of sphere_count, and of the tree, that can be sampled
    std::uint32_t sky_count;     // emitting ones of sphere_count that hold the camera, and so all paths
    HiddenCounts hidden;         // surfaces that the camera does not see
    std::uint32_t most_branches; // of a path at its first vertex, by the number of spheres
    std::uint32_t max_path_length;
    std::uint32_t estimator;
    std::uint32_t sampler;
    bool gloss;        // some material in use has a specular lobe
    bool motion;       // some sphere moves while the shutter is open
    bool capsules;     // some sphere is swept along a segment, in the tree or not
    bool curvature;    // some sphere is held as a plane with a curvature
    bool inside;       // the camera is inside a sphere held by centre and radius, or too near to its surface to tell
    bool planes_block; // some plane may stand between a surface that a path reaches and a lamp
    bool planes_emit;  // some plane, or sphere held as one, emits
    bool planes_move;  // some sphere held as a plane moves while the shutter is open
    bool known_sides;  // the camera tells the sides of surfaces, which is of use and possible
    bool close_lamps;  // some lamp nearly coincides with another sphere (twins.h)
    bool lamp_tree;    // lamps are chosen by a tree (lib/scene/lamp_tree.h)
    std::uint32_t spot_count; // of light_spots.h, to which the first vertex sends a ray of its own
    bool starts_ahead;        // camera rays start on a plane across the view (ray_start.h)
    bool orthographic;        // and are parallel
    bool lens;                // or start on a lens, likewise across the view
    bool scene_in_uniform;    // the scene, with the words of a material for each surface, fits into a uniform buffer
    std::uint32_t table_materials; // if it does not: the materials that its surfaces share
    bool tree;                     // most spheres are in a tree, and not among sphere_count
    std::uint32_t tree_levels;     // of nodes, rounded up, so that few trees want a kernel of their own
    bool tree_inside;              // the camera is inside one of them, or too near to its surface to tell
    bool tree_colors;              // with colors of their own
    bool tree_capsules;            // some of them are capsules
    bool tree_opacity;             // rays pass some of them at random
    std::uint32_t tree_lamps;      // of lamp_count, those in the tree, which come last

    bool operator==(const Features &) const = default;

    std::uint32_t surface_count() const { return sphere_count + plane_count; }
    std::uint32_t emitting_spheres() const { return lamp_count + sky_count; }
    std::uint32_t walked_lamps() const { return lamp_count - tree_lamps; }
};

// All features but spot_count (light_spots.h).
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

// Values of the specialization constants, by constant_id.
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
