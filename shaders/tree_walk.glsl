// Rays against the spheres of a tree. A walk finds what testing every sphere would find, whatever the tree: which of
// spheres at equal distances is seen depends on nothing but the spheres, and no box that may hold a nearer one is passed by.
#ifndef TREE_WALK_GLSL
#define TREE_WALK_GLSL

#include "ray_tests.glsl"
#include "tree_node.glsl"

// Set where a driver has stopped a walk before its end (some end loops after so many trips): the sample is lost.
bool walk_was_cut = false;

// Distances that include an advance are rounded by 2^-24 of it, so that what is a little farther may be as far, and may be
// what is seen: boxes are entered up to 2^-22 of the advance later.
const float ADVANCE_ROUNDED = 0.99999976; // 1 - 2^-22

// Of what is no sphere of the tree: it goes before all of them.
const uvec4 NO_SPHERE_WORD = uvec4(0u);

// Of spheres at equal distances that is seen whose word is first, so that it does not depend on the tree's shape. Where
// two differ by their motion alone it is the lower place; such a tree keeps no shape (sphere_tree.h).
void keep_closer_of_tree(inout Hit hit, inout uvec4 hit_word, float distance, uint surface, uvec4 word)
{
    bool as_close = distance == hit.distance && distance < NO_HIT;
    bool first = word.x != hit_word.x   ? word.x < hit_word.x
                 : word.y != hit_word.y ? word.y < hit_word.y
                 : word.z != hit_word.z ? word.z < hit_word.z
                 : word.w != hit_word.w ? word.w < hit_word.w
                                        : surface < hit.surface;
    bool closer = distance < hit.distance || (as_close && first);
    hit.distance = closer ? distance : hit.distance;
    hit.surface = closer ? surface : hit.surface;
    hit_word = closer ? word : hit_word;
}

// Distance along a direction to a sphere of the tree, or NO_HIT, and the sphere as the ray's start sees it.
float distance_in_tree(Start start, GridRay ray, vec3 direction, uint surface, vec4 ball, float time)
{
    vec3 from_side = KNOWN_SIDES == 1 ? tree_sphere(surface - SURFACE_COUNT, time).xyz : ball.xyz;
    bool outside = dot(from_side, from_side) > ball.w * ball.w;
    bool leaving = surface == start.surface;
    return ray.advance + sphere_distance(ball.xyz, ball.w, direction, leaving, start.inside, outside);
}

bool blocks_in_tree(Start start, GridRay ray, ShadowRay shadow, uint surface, vec4 ball, float time)
{
    if (INSIDE == 1 || CLOSE_LAMPS == 1)
        return blocks(shadow, distance_in_tree(start, ray, shadow.direction, surface, ball, time), surface);
    bool at_end = surface == start.surface || surface == shadow.lamp;
    return sphere_blocks(ball.xyz, ball.w, shadow.direction, at_end, shadow.distance - ray.advance);
}

// See ended_as_met of ray_tests.glsl.
ShadowRay ended_as_met_in_tree(ShadowRay shadow, Start start, float time)
{
    if (CLOSE_LAMPS == 1 && TREE_LAMPS > 0u && shadow.distance > 0.0 && shadow.lamp >= SURFACE_COUNT) {
        GridRay ray = grid_ray(start.origin, shadow.direction);
        vec4 ball = tree_sphere_from(ray.base, ray.rest, shadow.lamp - SURFACE_COUNT, time);
        float distance = distance_in_tree(start, ray, shadow.direction, shadow.lamp, ball, time);
        shadow.distance = distance < NO_HIT ? distance : shadow.distance;
    }
    return shadow;
}

// Follows the shadow ray, if there is one, and then the other, if it is to be followed, in one loop: where invocations
// run in step, those whose shadow ray ends early go on with the other, which made walks half as fast again as two loops.
// hit and blocked: of the other surfaces, before, and of all of them after.
void walk_tree(inout Hit hit, inout bool blocked, Start start, vec3 direction, bool is_followed, ShadowRay shadow,
               float time)
{
    GridRay path_ray = grid_ray(start.origin, direction);
    GridRay shadow_ray = grid_ray(start.origin, shadow.direction);
    vec3 path_inverse = inverse_of(direction);
    vec3 shadow_inverse = inverse_of(shadow.direction);
    bool follows_path = is_followed && path_ray.is_near;
    bool in_shadow = shadow.distance > 0.0 && !blocked && shadow_ray.is_near;
    uvec4 hit_word = NO_SPHERE_WORD;

    // A node and a sphere a trip at the most, so that there is one loop.
    const Group root = Group(0u, 0u, 1u);
    const Group nothing = Group(0u, 0u, 0u);
    uint stack[TREE_STACK_SIZE];
    const int ended = -1; // a height that tells: of done itself compilers know that it is true after the loop
    int height = 0;
    Group group = in_shadow || follows_path ? root : nothing;
    uint first_place = 0u;
    uint spheres = 0u;
    bool done;
    do {
        GridRay ray = path_ray;
        if (in_shadow)
            ray = shadow_ray;

        // The nearest node of the group; the others are kept for later.
        if (spheres == 0u && group.count > 0u) {
            uint node = group.first_child + (group.places & 3u);
            group.places >>= 2;
            --group.count;
            stack[height] = packed_group(group);
            height += group.count > 0u ? 1 : 0;
            vec3 inverse = in_shadow ? shadow_inverse : path_inverse;
            float before = in_shadow ? shadow.distance : hit.distance;
            Entered entered = enter_node(node, ray, inverse, before - ray.advance * ADVANCE_ROUNDED);
            group = entered.inner;
            first_place = entered.first_place;
            spheres = entered.spheres;
        }

        // The next sphere.
        if (spheres != 0u) {
            uint place = first_place + uint(findLSB(spheres));
            spheres &= spheres - 1u;
            uint surface = SURFACE_COUNT + place;
            uvec4 word = tree_sphere_word(place);
            vec4 ball = tree_sphere_of(word, ray.base, ray.rest, place, time);
            if (in_shadow)
                blocked = blocks_in_tree(start, ray, shadow, surface, ball, time);
            else
                keep_closer_of_tree(hit, hit_word, distance_in_tree(start, ray, direction, surface, ball, time), surface,
                                    word);
        }

        // What is left of this ray, or the other ray.
        bool is_empty = spheres == 0u && group.count == 0u;
        bool ray_ends = (is_empty && height == 0) || (in_shadow && blocked);
        height -= is_empty && height > 0 ? 1 : 0;
        if (is_empty)
            group = unpacked_group(stack[height]);
        done = ray_ends && !in_shadow;
        if (ray_ends) {
            in_shadow = false;
            group = follows_path ? root : nothing;
            spheres = 0u;
            height = done ? ended : 0;
        }
    } while (!done);
    walk_was_cut = walk_was_cut || height != ended;
}

#endif
