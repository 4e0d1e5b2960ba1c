// Access to the scene buffer as gpu_layout.h describes it, and the constants that fit the kernel to the scene.
// Used by intersect.glsl, phong.glsl, lights.glsl and path.glsl.
#ifndef SCENE_GLSL
#define SCENE_GLSL

#include "gpu_layout.h"

layout(constant_id = ID_SPHERE_COUNT) const uint SPHERE_COUNT = 1;
layout(constant_id = ID_PLANE_COUNT) const uint PLANE_COUNT = 0;
layout(constant_id = ID_LAMP_COUNT) const uint LAMP_COUNT = 0;
layout(constant_id = ID_MAX_PATH_LENGTH) const uint MAX_PATH_LENGTH = 2;
layout(constant_id = ID_ESTIMATOR) const uint ESTIMATOR = ESTIMATOR_MIS;
layout(constant_id = ID_GLOSS) const uint GLOSS = 1;
layout(constant_id = ID_MOTION) const uint MOTION = 1;
layout(constant_id = ID_SCENE_IN_UNIFORM) const uint SCENE_IN_UNIFORM = 1;
layout(constant_id = ID_SAMPLER) const uint SAMPLER = SAMPLER_RANDOM;
layout(constant_id = ID_TABLE_DIMENSIONS) const uint TABLE_DIMENSIONS = 0;
layout(constant_id = ID_BRANCH_COUNT) const uint BRANCH_COUNT = 1;
layout(constant_id = ID_CURVATURE) const uint CURVATURE = 0;

layout(set = 0, binding = BINDING_SCENE_UNIFORM) uniform SceneUniform {
    vec4 words[UNIFORM_SCENE_WORDS];
} scene_uniform;
layout(set = 0, binding = BINDING_SCENE_STORAGE) readonly buffer SceneStorage { vec4 words[]; } scene_storage;

const uint SURFACE_COUNT = SPHERE_COUNT + PLANE_COUNT;

// A surface is its index: spheres first, then planes.
const uint NO_SURFACE = 0xffffffffu;

// Runs a statement for each index from first to end - 1, both constants. Loops over few indices are unrolled, which
// gained a tenth of the speed with 32 surfaces; with 4096 it would cost minutes of compilation.
const uint UNROLL_LIMIT = 32u;
#define FOR_EACH(index, first, end, statement)                                                                         \
    if ((end) > (first)) {                                                                                             \
        uint index = (first);                                                                                          \
        if ((end) - (first) <= UNROLL_LIMIT) {                                                                         \
            [[unroll]] do {                                                                                            \
                statement;                                                                                             \
                ++index;                                                                                               \
            } while (index < (end));                                                                                   \
        } else {                                                                                                       \
            do {                                                                                                       \
                statement;                                                                                             \
                ++index;                                                                                               \
            } while (index < (end));                                                                                   \
        }                                                                                                              \
    }

vec4 scene_word(uint index)
{
    return SCENE_IN_UNIFORM == 1 ? scene_uniform.words[index] : scene_storage.words[index];
}

// Sphere: centre as the shutter opens and radius. Plane: unit normal and offset.
vec4 geometry_of(uint surface) { return scene_word(surface); }

// Radiance and its mean.
vec4 emission_of(uint surface) { return scene_word(SURFACE_COUNT + surface); }

// Diffuse albedo and the probability of choosing the specular lobe.
vec4 diffuse_of(uint surface) { return scene_word(2u * SURFACE_COUNT + surface); }

// Specular factor and glossiness.
vec4 specular_of(uint surface) { return GLOSS == 1 ? scene_word(3u * SURFACE_COUNT + surface) : vec4(0.0); }

// Centre and radius at a time, from 0 (shutter opens) to 1 (shutter closes): the one function that tracing, lamp
// sampling and densities share.
vec4 sphere_at(uint sphere, float time)
{
    vec4 centre_radius = geometry_of(sphere);
    if (MOTION == 1)
        centre_radius.xyz += time * scene_word((3u + GLOSS) * SURFACE_COUNT + sphere).xyz;
    return centre_radius;
}

// Where a point lies with respect to a plane.
struct Level {
    float height;    // above it, on the side of its normal
    vec3 gradient;   // of the height: the normal, at points of the plane
    float curvature; // of the plane
};

// A sphere that is huge against its distance is a plane with the curvature k = 1 / R. With its point nearest to the
// camera, p = -offset n, the outward unit normal n there, y = x - p and the centre p - n / k, the height is
//     (|x - centre|^2 - R^2) / (2 R) = n . y + k / 2 |y|^2,
// 0 on the sphere, and its gradient is n + k y. The left side loses 2^-24 R to rounding; the right one, 2^-24 of the
// distances in the scene. Its limit k = 0 is the plane.
Level level_at(uint plane, vec3 point)
{
    vec4 normal_offset = geometry_of(plane);
    Level level = Level(dot(normal_offset.xyz, point) + normal_offset.w, normal_offset.xyz, 0.0);
    if (CURVATURE == 1) {
        level.curvature = scene_word((3u + GLOSS) * SURFACE_COUNT + MOTION * SPHERE_COUNT + plane - SPHERE_COUNT).x;
        vec3 from_nearest = point + normal_offset.w * normal_offset.xyz;
        vec3 bend = level.curvature * from_nearest;
        level.height += 0.5 * dot(bend, from_nearest);
        level.gradient += bend;
    }
    return level;
}

#endif
