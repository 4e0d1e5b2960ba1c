// Specialization constants of kernels that trace rays: name, constant_id, default. The host's values are in Features
// (scene_features.h).
#ifndef PT_SPECIALIZATION_H
#define PT_SPECIALIZATION_H

#include "gpu_layout.h"

#ifdef __cplusplus
namespace pt::gpu {
#define PT_SPECIALIZED(name, id, initial) constexpr uint ID_##name = id;
#else
#define PT_SPECIALIZED(name, id, initial) layout(constant_id = id) const uint name = initial;
#endif

PT_SPECIALIZED(SPHERE_COUNT, 0, 1)    // spheres outside the tree; emitting ones come first
PT_SPECIALIZED(PLANE_COUNT, 1, 0)     // planes, and spheres stored as curved planes (seen_scene.h)
PT_SPECIALIZED(LAMP_COUNT, 2, 0)      // emitting spheres that can be sampled
PT_SPECIALIZED(MAX_PATH_LENGTH, 3, 2) // vertices after the camera
PT_SPECIALIZED(ESTIMATOR, 4, ESTIMATOR_MIS)
PT_SPECIALIZED(GLOSS, 5, 1)
PT_SPECIALIZED(MOTION, 6, 1)
PT_SPECIALIZED(SCENE_SOURCE, 7, SCENE_IN_UNIFORM)
PT_SPECIALIZED(SAMPLER, 8, SAMPLER_RANDOM)
PT_SPECIALIZED(TABLE_BLOCKS, 9, 0)  // blocks of the point table: shared ones and the blocks of one branch
PT_SPECIALIZED(BRANCH_COUNT, 10, 1) // branches at a path's first vertex
PT_SPECIALIZED(CURVATURE, 11, 0)
PT_SPECIALIZED(INSIDE, 13, 1)       // 1: paths may be inside a sphere
PT_SPECIALIZED(PLANES_BLOCK, 14, 1)
PT_SPECIALIZED(PLANES_EMIT, 16, 1)
PT_SPECIALIZED(SKY_COUNT, 17, 0)        // emitting spheres around the camera
PT_SPECIALIZED(KNOWN_SIDES, 18, 0)      // 1: paths stay on the camera's side of each surface
PT_SPECIALIZED(CLOSE_LAMPS, 20, 1)      // 1: a lamp nearly coincides with another sphere (twins.h)
PT_SPECIALIZED(STARTS_AHEAD, 21, 1)     // 1: camera rays start on a plane (projection.h)
PT_SPECIALIZED(PROJECTION, 29, 0)      // PROJECTION_*
PT_SPECIALIZED(LENS, 39, 0)
PT_SPECIALIZED(LAMP_TREE_LEVELS, 25, 0) // levels below the top; 0: no lamp tree
PT_SPECIALIZED(LAMP_TREE_WORDS, 26, 0)
PT_SPECIALIZED(OVERLAP, 15, 0)         // 1: several invocations may add to a pixel at once
PT_SPECIALIZED(TREE, 22, 0)
PT_SPECIALIZED(TREE_LAMPS, 23, 0)      // lamps in the tree; they have the last numbers
PT_SPECIALIZED(TREE_COLORS, 24, 0)     // 1: tree spheres have colors of their own
PT_SPECIALIZED(TREE_LEVELS, 35, 0)     // nodes from the root to the deepest sphere
PT_SPECIALIZED(TREE_INSIDE, 34, 1)     // 1: paths may be inside a sphere of the tree
PT_SPECIALIZED(POINT_BLOCKS, 12, 1024)
PT_SPECIALIZED(WALK_TRIPS, 27, 0)      // iteration limit of a step (tree_path.glsl); 0: each walk runs to its end
PT_SPECIALIZED(SPOT_COUNT, 28, 0)
// Numbers of surfaces hidden from the camera. lib/view/kernel_surfaces.h describes their order.
PT_SPECIALIZED(HIDDEN_LAMPS, 30, 0)
PT_SPECIALIZED(HIDDEN_SKIES, 31, 0)
PT_SPECIALIZED(HIDDEN_OTHERS, 32, 0)
PT_SPECIALIZED(HIDDEN_PLANES, 33, 0)
PT_SPECIALIZED(UNIFORM_READS, 38, 0) // 1: stored_word() reads the uniform buffer
PT_SPECIALIZED(KINDS, 40, 1)         // kinds of the spheres outside the tree
PT_SPECIALIZED(TREE_KINDS, 41, 1)    // kinds of the spheres in the tree
PT_SPECIALIZED(TREE_OPACITY, 19, 0)  // 1: rays pass through tree spheres at random
PT_SPECIALIZED(COVERAGE, 42, 0)      // 1: camera rays that hit a surface are counted
PT_SPECIALIZED(UNROLLED, 36, 112)    // iteration limit of unrolled loops
PT_SPECIALIZED(INTEGER_ORDER, 37, 0) // 1: comparisons of integers are faster
const uint CONSTANT_COUNT = 43;
// Component i of scene word w is constant_id CONSTANT_COUNT + 4 w + i.
const uint CONSTANT_SCENE_WORDS = 64;

// An estimator that does not sample lamps finds them by chance.
#define PT_SAMPLES_LAMPS (ESTIMATOR == ESTIMATOR_MIS || ESTIMATOR == ESTIMATOR_LIGHT)
#define PT_SAMPLES_LOBES (ESTIMATOR != ESTIMATOR_UNIFORM && ESTIMATOR != ESTIMATOR_COSINE)

#ifdef __cplusplus
constexpr bool samples_lamps(uint ESTIMATOR) { return PT_SAMPLES_LAMPS; }
constexpr bool samples_lobes(uint ESTIMATOR) { return PT_SAMPLES_LOBES; }
} // namespace pt::gpu
#endif
#undef PT_SPECIALIZED

#ifndef __cplusplus
const bool STARTS_ON_DISC = PROJECTION == PROJECTION_ORTHOGRAPHIC || LENS == 1u; // starts of camera rays differ
const uint CAMERA_BLOCKS = 1u + LENS;                                            // blocks of a camera ray
#endif

#endif
