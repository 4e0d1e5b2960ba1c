// Specialization constants of kernels that trace rays: name, constant_id, default. Included by the GLSL sources and by
// lib/, where Features holds the values.
#ifndef PT_SPECIALIZATION_H
#define PT_SPECIALIZATION_H

#include "gpu_layout.h"

#ifdef __cplusplus
namespace pt::gpu {
#define PT_SPECIALIZED(name, id, initial) constexpr uint ID_##name = id;
#else
#define PT_SPECIALIZED(name, id, initial) layout(constant_id = id) const uint name = initial;
#endif

PT_SPECIALIZED(SPHERE_COUNT, 0, 1)        // outside the tree; emitting ones first
PT_SPECIALIZED(PLANE_COUNT, 1, 0)         // and spheres held as curved planes (seen_scene.h)
PT_SPECIALIZED(LAMP_COUNT, 2, 0)          // emitting spheres that can be sampled, in the tree or not
PT_SPECIALIZED(MAX_PATH_LENGTH, 3, 2)     // surface vertices after the camera
PT_SPECIALIZED(ESTIMATOR, 4, ESTIMATOR_MIS)
PT_SPECIALIZED(GLOSS, 5, 1)               // 1: some material has a specular lobe
PT_SPECIALIZED(MOTION, 6, 1)              // 1: some sphere moves
PT_SPECIALIZED(SCENE_SOURCE, 7, SCENE_IN_UNIFORM)
PT_SPECIALIZED(SAMPLER, 8, SAMPLER_RANDOM)
PT_SPECIALIZED(TABLE_BLOCKS, 9, 0)        // blocks of a sample and one branch in the point table
PT_SPECIALIZED(BRANCH_COUNT, 10, 1)       // directions from a path's first vertex
PT_SPECIALIZED(CURVATURE, 11, 0)          // 1: some plane is curved
PT_SPECIALIZED(INSIDE, 13, 1)             // 1: paths may be inside a sphere, as the camera is or may be
PT_SPECIALIZED(PLANES_BLOCK, 14, 1)       // 1: a plane may block a lamp from a surface with paths
PT_SPECIALIZED(PLANES_EMIT, 16, 1)        // 1: a plane, or sphere held as one, emits
PT_SPECIALIZED(SKY_COUNT, 17, 0)          // emitting spheres around the camera, after the lamps
PT_SPECIALIZED(KNOWN_SIDES, 18, 0)        // 1: the camera, on no plane, decides the sides of surfaces
PT_SPECIALIZED(CLOSE_LAMPS, 20, 1)        // 1: some lamp nearly coincides with another sphere (twins.h)
PT_SPECIALIZED(STARTS_AHEAD, 21, 1)       // 1: camera rays start on a plane across the view (ray_start.h), ...
PT_SPECIALIZED(ORTHOGRAPHIC, 29, 0)       // 1: ... and are parallel
PT_SPECIALIZED(LENS, 39, 0)               // 1: ... or start on a lens across the view
PT_SPECIALIZED(LAMP_TREE_LEVELS, 25, 0)   // of the tree of lamps, below its top; 0: no tree
PT_SPECIALIZED(LAMP_TREE_WORDS, 26, 0)    // words of the tree of lamps
PT_SPECIALIZED(OVERLAP, 15, 0)            // 1: several dispatches or invocations may add to a pixel at once
PT_SPECIALIZED(TREE, 22, 0)               // 1: most spheres are in a tree
PT_SPECIALIZED(TREE_LAMPS, 23, 0)         // lamps in the tree, the last of LAMP_COUNT
PT_SPECIALIZED(TREE_COLORS, 24, 0)        // 1: tree spheres have colors of their own
PT_SPECIALIZED(TREE_LEVELS, 35, 0)        // at least the nodes on the longest way down
PT_SPECIALIZED(TREE_INSIDE, 34, 1)        // 1: the camera is, or may be, inside a sphere of the tree
PT_SPECIALIZED(POINT_BLOCKS, 12, 1024)    // blocks in the binding of the point table
PT_SPECIALIZED(WALK_TRIPS, 27, 0)         // trips before finished walks are left; 0: every walk is ended
PT_SPECIALIZED(SPOT_COUNT, 28, 0)         // spots, which get a ray of their own (spots.glsl)
// Surfaces that camera rays pass through: the last lamps outside the tree, first skies, last other spheres, first
// planes.
PT_SPECIALIZED(HIDDEN_LAMPS, 30, 0)
PT_SPECIALIZED(HIDDEN_SKIES, 31, 0)
PT_SPECIALIZED(HIDDEN_OTHERS, 32, 0)
PT_SPECIALIZED(HIDDEN_PLANES, 33, 0)
PT_SPECIALIZED(UNIFORM_READS, 38, 0)      // 1: the scene buffer is short and read as a uniform
PT_SPECIALIZED(KINDS, 40, 1)              // of balls, in the tree or not: KIND_BALL and others
PT_SPECIALIZED(TREE_KINDS, 41, 1)         // of balls in the tree
PT_SPECIALIZED(TREE_OPACITY, 19, 0)       // 1: rays pass through tree spheres at random
PT_SPECIALIZED(UNROLLED, 36, 112)         // most surfaces of unrolled loops
PT_SPECIALIZED(INTEGER_ORDER, 37, 0)      // 1: integer comparisons are faster (maths.glsl)
const uint CONSTANT_COUNT = 42;
// With SCENE_IN_CONSTANTS, component i of scene word w is constant_id CONSTANT_COUNT + 4 w + i.
const uint CONSTANT_SCENE_WORDS = 64;

#ifdef __cplusplus
} // namespace pt::gpu
#endif
#undef PT_SPECIALIZED

#ifndef __cplusplus
const bool STARTS_ON_DISC = ORTHOGRAPHIC + LENS > 0; // camera rays do not start at or just ahead of one point
const uint CAMERA_BLOCKS = 1u + LENS;                // blocks of a camera ray
#endif

#endif
