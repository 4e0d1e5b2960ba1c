#ifndef SCENE_GLSL
#define SCENE_GLSL

#include "ball.glsl"
#include "gpu_layout.h"
#include "scene_constants.glsl"
#include "specialization.h"

#extension GL_EXT_control_flow_attributes : require

layout(set = 0, binding = BINDING_SCENE_UNIFORM) uniform SceneUniform {
    vec4 words[UNIFORM_SCENE_WORDS];
} scene_uniform;
layout(set = 0, binding = BINDING_SCENE_STORAGE) readonly buffer SceneStorage { vec4 words[]; } scene_storage;

const uint SURFACE_COUNT = SPHERE_COUNT + PLANE_COUNT;

// Runs a statement for each index from first to end - 1.
#define FOR_EACH(index, first, end, statement)                                                                         \
    if ((end) > (first)) {                                                                                             \
        uint index = (first);                                                                                          \
        if ((end) - (first) <= UNROLLED) {                                                                             \
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

// `index` may differ between invocations.
vec4 stored_word(uint index)
{
    return UNIFORM_READS == 1u ? scene_uniform.words[index] : scene_storage.words[index];
}

// `index` must be constant after loops are unrolled.
vec4 scene_word(uint index)
{
    if (SCENE_SOURCE == SCENE_IN_CONSTANTS)
        return scene_constants[index];
    return SCENE_SOURCE == SCENE_IN_UNIFORM ? scene_uniform.words[index] : stored_word(index);
}

// Returns word first + index. index < count may differ between invocations. Constants have no addresses, so index is
// compared with all possible values. A condition that is never true prevents constant folding, so that all scene
// sources round alike.
vec4 scene_word_among(uint first, uint count, uint index)
{
    if (SCENE_SOURCE != SCENE_IN_CONSTANTS)
        return scene_word(first + index);
    vec4 word = gl_GlobalInvocationID.x == 0xffffffffu ? vec4(0.0) : scene_word(first);
    if (count > 1u) {
        uint i = 1u;
        [[unroll]] do {
            word = index == i ? scene_word(first + i) : word;
            ++i;
        } while (i < count);
    }
    return word;
}

// Whether surfaces of one material share its words. This is slower in small scenes.
const bool HAS_TABLE = SCENE_SOURCE == SCENE_IN_STORAGE;

const uint EMISSION = SURFACE_COUNT;
const uint EMITTING_SPHERES = LAMP_COUNT + SKY_COUNT;
const uint DIFFUSE = 2u * SURFACE_COUNT;
const uint SPECULAR = 3u * SURFACE_COUNT;
const uint MOTIONS = HAS_TABLE ? EMISSION + EMITTING_SPHERES + PLANES_EMIT * PLANE_COUNT : (3u + GLOSS) * SURFACE_COUNT;
const uint CURVATURES = MOTIONS + (HAS_WAYS ? SPHERE_COUNT : 0u);
const uint LAMP_TREE = CURVATURES + CURVATURE * PLANE_COUNT;
// The uniform buffer has SPOTS here; the storage buffer has the blocks from INDICES on.
const uint SPOTS = LAMP_TREE + LAMP_TREE_WORDS;
const uint INDICES = LAMP_TREE + LAMP_TREE_WORDS;
const uint TREE_FRAME = INDICES + (SURFACE_COUNT + 3u) / 4u;
const uint TABLE = TREE_FRAME + 5u * TREE;

#include "tree.glsl"

uint stored_index(uint block, uint index)
{
    return floatBitsToUint(stored_word(block + index / 4u)[index % 4u]) - MATERIAL_INDEX_BITS;
}

// First word of a surface's material in the storage buffer.
uint material_words(uint surface)
{
    bool in_tree = TREE == 1u && surface >= SURFACE_COUNT;
    return TABLE + (1u + GLOSS) * (in_tree ? tree_material(surface - SURFACE_COUNT) : stored_index(INDICES, surface));
}

// Lamps outside the tree have lamp numbers equal to their surface numbers. Lamps in the tree follow.
const uint WALKED_LAMPS = LAMP_COUNT - TREE_LAMPS;

// Returns the lamp's number. For other surfaces it is LAMP_COUNT or greater.
uint lamp_of(uint surface)
{
    if (TREE_LAMPS == 0u)
        return surface;
    uint lamp = surface < SURFACE_COUNT ? NO_SURFACE : tree_lamp(surface - SURFACE_COUNT);
    return surface < WALKED_LAMPS ? surface : lamp < TREE_LAMPS ? WALKED_LAMPS + lamp : NO_SURFACE;
}

uint surface_of_lamp(uint lamp)
{
    if (TREE_LAMPS == 0u || lamp < WALKED_LAMPS)
        return lamp;
    return SURFACE_COUNT + tree_lamp_place(lamp - WALKED_LAMPS);
}

bool may_emit(uint surface)
{
    bool is_lamp = TREE_LAMPS > 0u && surface >= SURFACE_COUNT && lamp_of(surface) < LAMP_COUNT;
    bool is_plane = surface >= SPHERE_COUNT && (TREE == 0u || surface < SURFACE_COUNT);
    return surface < WALKED_LAMPS + SKY_COUNT || (PLANES_EMIT == 1u && is_plane) || is_lamp;
}

vec4 emission_of(uint surface)
{
    if (!HAS_TABLE)
        return scene_word_among(EMISSION, PLANES_EMIT == 1u ? SURFACE_COUNT : EMITTING_SPHERES, surface);
    if (TREE_LAMPS > 0u && (surface < WALKED_LAMPS || surface >= SURFACE_COUNT))
        return scene_word(EMISSION + lamp_of(surface));
    return scene_word(EMISSION + (surface < SPHERE_COUNT ? surface + TREE_LAMPS
                                                         : surface - SPHERE_COUNT + EMITTING_SPHERES));
}

vec4 emission_of_lamp(uint lamp) { return scene_word_among(EMISSION, LAMP_COUNT, lamp); }

vec4 diffuse_of(uint surface)
{
    if (TREE_COLORS == 1u && surface >= SURFACE_COUNT) {
        vec4 word = scene_word(material_words(surface));
        return vec4(word.rgb * tree_color(surface - SURFACE_COUNT), word.a);
    }
    return HAS_TABLE ? scene_word(material_words(surface)) : scene_word_among(DIFFUSE, SURFACE_COUNT, surface);
}

vec4 specular_of(uint surface)
{
    if (GLOSS == 0)
        return vec4(0.0);
    return HAS_TABLE ? scene_word(material_words(surface) + 1u) : scene_word_among(SPECULAR, SURFACE_COUNT, surface);
}

// The sphere at a time in [0, 1]. `sphere` must be constant after loops are unrolled.
Ball ball_at(uint sphere, float time)
{
    return ball_from(scene_word(sphere), HAS_WAYS ? scene_word(MOTIONS + sphere) : vec4(0.0), time, KINDS);
}

// ball_at() for an index below count that may differ between invocations.
Ball ball_among(uint count, uint sphere, float time)
{
    vec4 way = HAS_WAYS ? scene_word_among(MOTIONS, count, sphere) : vec4(0.0);
    return ball_from(scene_word_among(0u, count, sphere), way, time, KINDS);
}

bool is_sphere(uint surface)
{
    return surface < SPHERE_COUNT || (TREE == 1u && surface >= SURFACE_COUNT);
}

Ball ball_of(uint surface, float time)
{
    if (TREE == 1u && surface >= SURFACE_COUNT)
        return tree_ball(surface - SURFACE_COUNT, time);
    return ball_among(SPHERE_COUNT, surface, time);
}

Ball ball_of_lamp(uint lamp, float time)
{
    if (TREE_LAMPS > 0u && lamp >= WALKED_LAMPS)
        return tree_ball(tree_lamp_place(lamp - WALKED_LAMPS), time);
    return ball_among(WALKED_LAMPS, lamp, time);
}

vec4 bound_of_lamp(uint lamp, float time) { return ball_of_lamp(lamp, time).center_radius; }

bool is_walked_lamp(uint surface) { return TREE_LAMPS == 0u || surface < WALKED_LAMPS; }

struct Level {
    float height;  // signed distance from the plane, positive on the normal's side
    vec3 gradient; // gradient of the height
    float curvature;
};

// A sphere far larger than its distance is stored as a plane with a curvature (shaders/README.md, section 3). Returns
// the h(x) of that section and its gradient. Motion by m replaces x by x - t m.
Level level_of(vec4 normal_offset, vec4 curvature_motion, vec3 point, float time)
{
    vec4 n = normal_offset;
    if (CURVATURE == 1 && MOTION == 1)
        point -= time * curvature_motion.yzw;
    float curvature = curvature_motion.x;
    Level level = Level(n.x * point.x + (n.y * point.y + (n.z * point.z + n.w)), n.xyz, curvature);
    if (CURVATURE == 1) {
        vec3 from_nearest = point + normal_offset.w * normal_offset.xyz;
        vec3 bend = curvature * from_nearest;
        level.height += 0.5 * dot(bend, from_nearest);
        level.gradient += bend;
    }
    return level;
}

Level level_at(uint plane, vec3 point, float time)
{
    vec4 curvature = CURVATURE == 1 ? scene_word(CURVATURES + plane - SPHERE_COUNT) : vec4(0.0);
    return level_of(scene_word(plane), curvature, point, time);
}

// level_at() for an index that may differ between invocations.
Level level_among(uint plane, vec3 point, float time)
{
    uint index = plane - SPHERE_COUNT;
    vec4 curvature = CURVATURE == 1 ? scene_word_among(CURVATURES, PLANE_COUNT, index) : vec4(0.0);
    return level_of(scene_word_among(SPHERE_COUNT, PLANE_COUNT, index), curvature, point, time);
}

float camera_height(uint plane, float time)
{
    return CURVATURE == 1 && MOTION == 1 ? level_at(plane, vec3(0.0), time).height : scene_word(plane).w;
}

#endif
