// What kernels that trace rays are specialised to: the name of each constant, its constant_id, and the value in kernels
// whose host sets none. Included by the GLSL sources and, for the host, by lib/, where Features holds the values.
#ifndef PT_SPECIALIZATION_H
#define PT_SPECIALIZATION_H

#include "gpu_layout.h"

#ifdef __cplusplus
namespace pt::gpu {
#define PT_SPECIALIZED(name, id, initial) constexpr uint ID_##name = id;
#else
#define PT_SPECIALIZED(name, id, initial) layout(constant_id = id) const uint name = initial;
#endif

PT_SPECIALIZED(SPHERE_COUNT, 0, 1)        // spheres held by centre and radius; the emitting ones come first
PT_SPECIALIZED(PLANE_COUNT, 1, 0)         // planes, and spheres held as planes with a curvature (seen_scene.h)
PT_SPECIALIZED(LAMP_COUNT, 2, 0)          // emitting spheres among SPHERE_COUNT, and in the tree, that can be sampled
PT_SPECIALIZED(MAX_PATH_LENGTH, 3, 2)     // surface vertices after the camera
PT_SPECIALIZED(ESTIMATOR, 4, ESTIMATOR_MIS)
PT_SPECIALIZED(GLOSS, 5, 1)               // 1: some material in use has a specular lobe
PT_SPECIALIZED(MOTION, 6, 1)              // 1: some sphere moves while the shutter is open
PT_SPECIALIZED(SCENE_SOURCE, 7, SCENE_IN_UNIFORM)
PT_SPECIALIZED(SAMPLER, 8, SAMPLER_RANDOM)
PT_SPECIALIZED(TABLE_BLOCKS, 9, 0)        // blocks of a sample and one of its branches that are in the point table
PT_SPECIALIZED(BRANCH_COUNT, 10, 1)       // directions in which a path leaves its first vertex
PT_SPECIALIZED(CURVATURE, 11, 0)          // 1: some plane has a curvature
PT_SPECIALIZED(INSIDE, 13, 1)             // 1: the camera is inside a sphere, or too near to tell, so paths may be
PT_SPECIALIZED(PLANES_BLOCK, 14, 1)       // 1: a plane may stand between a surface that a path reaches and a lamp
PT_SPECIALIZED(PLANES_EMIT, 16, 1)        // 1: some plane, or sphere held as one, emits
PT_SPECIALIZED(SKY_COUNT, 17, 0)          // emitting spheres that hold the camera, next after the lamps
PT_SPECIALIZED(KNOWN_SIDES, 18, 0)        // 1: the camera, on no plane, tells the sides of surfaces that have paths
PT_SPECIALIZED(CLOSE_LAMPS, 20, 1)        // 1: some lamp nearly coincides with another sphere (twins.h)
PT_SPECIALIZED(STARTS_AHEAD, 21, 1)       // 1: camera rays start on a plane across the view (ray_start.h), ...
PT_SPECIALIZED(ORTHOGRAPHIC, 29, 0)       // 1: and are parallel
PT_SPECIALIZED(LENS, 39, 0)               // 1: or start on a lens, likewise across the view
PT_SPECIALIZED(LAMP_TREE_LEVELS, 25, 0)   // of the tree of lamps, below its top; 0: there is none
PT_SPECIALIZED(LAMP_TREE_WORDS, 26, 0)    // of the scene buffer that are the tree's
PT_SPECIALIZED(OVERLAP, 15, 0)            // 1: dispatches, and invocations of one, may add to a pixel at the same time
PT_SPECIALIZED(TREE, 22, 0)               // 1: most spheres are in a tree
PT_SPECIALIZED(TREE_LAMPS, 23, 0)         // lamps among them, the last ones of LAMP_COUNT
PT_SPECIALIZED(TREE_COLORS, 24, 0)        // 1: spheres of the tree have colors of their own
PT_SPECIALIZED(TREE_LEVELS, 35, 0)        // nodes on the way to the deepest, or some more
PT_SPECIALIZED(TREE_INSIDE, 34, 1)        // 1: the camera is inside a sphere of the tree, or too near to tell
PT_SPECIALIZED(POINT_BLOCKS, 12, 1024)    // blocks that the binding of the point table holds
PT_SPECIALIZED(WALK_TRIPS, 27, 0)         // trips after which ended walks are left; 0: an invocation ends each walk
PT_SPECIALIZED(SPOT_COUNT, 28, 0)         // spots to which the first vertex sends a ray of its own (spots.glsl)
// How many surfaces camera rays pass through: the last of the lamps that are not in the tree, the first skies, the last
// of the spheres that do not emit, and the first planes.
PT_SPECIALIZED(HIDDEN_LAMPS, 30, 0)
PT_SPECIALIZED(HIDDEN_SKIES, 31, 0)
PT_SPECIALIZED(HIDDEN_OTHERS, 32, 0)
PT_SPECIALIZED(HIDDEN_PLANES, 33, 0)
PT_SPECIALIZED(UNIFORM_READS, 38, 0)      // 1: the scene buffer has few words, which are read by the uniform binding
PT_SPECIALIZED(KINDS, 40, 1)              // of spheres, in the tree or not: KIND_BALL and others
PT_SPECIALIZED(TREE_KINDS, 41, 1)         // of those in the tree
PT_SPECIALIZED(TREE_OPACITY, 19, 0)       // 1: rays pass spheres of the tree at random
PT_SPECIALIZED(UNROLLED, 36, 112)         // surfaces over which loops are unrolled, at the most
PT_SPECIALIZED(INTEGER_ORDER, 37, 0)      // 1: integers are compared faster than floats (maths.glsl)
const uint CONSTANT_COUNT = 42;
// With SCENE_IN_CONSTANTS the floats of the scene buffer follow, component i of word w as constant_id
// CONSTANT_COUNT + 4 w + i.
const uint CONSTANT_SCENE_WORDS = 64;

#ifdef __cplusplus
} // namespace pt::gpu
#endif
#undef PT_SPECIALIZED

#ifndef __cplusplus
const bool STARTS_ON_DISC = ORTHOGRAPHIC + LENS > 0; // not all camera rays at one point, nor just ahead of one
const uint CAMERA_BLOCKS = 1u + LENS;                // of numbers, which a camera ray takes
#endif

#endif
