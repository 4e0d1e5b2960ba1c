// Rays against the spheres of a tree. A walk finds what testing every sphere would find, whatever the tree: of spheres at
// equal distances the lower surface is seen, and no box that may hold a nearer one is passed by.
#ifndef TREE_WALK_GLSL
#define TREE_WALK_GLSL

#include "ray_tests.glsl"
#include "tree_node.glsl"

// Set where a driver has stopped a walk before its end (some end loops after so many trips): the sample is lost.
bool walk_was_cut = false;

void keep_closer_of_tree(inout Hit hit, float distance, uint surface)
{
    bool closer = distance < hit.distance || (distance == hit.distance && distance < NO_HIT && surface < hit.surface);
    hit.distance = closer ? distance : hit.distance;
    hit.surface = closer ? surface : hit.surface;
}

// Follows the shadow ray, if there is one, and then the other, if it is to be followed, in one loop: where invocations
// run in step, those whose shadow ray ends early go on with the other, which made walks half as fast again as two loops.
// hit and blocked: of the other surfaces, before, and of all of them after.
void walk_tree(inout Hit hit, inout bool blocked, Start start, vec3 direction, bool is_followed, ShadowRay shadow,
               float time)
{
    GridRay ray = grid_ray(start.origin);
    vec3 inverse = inverse_of(direction);
    vec3 shadow_inverse = inverse_of(shadow.direction);
    bool in_shadow = shadow.distance > 0.0 && !blocked;

    // A node and a sphere a trip at the most, so that there is one loop.
    const Group root = Group(0u, 0u, 1u);
    const Group nothing = Group(0u, 0u, 0u);
    uint stack[TREE_STACK_SIZE];
    int height = 0;
    Group group = in_shadow || is_followed ? root : nothing;
    uint first_place = 0u;
    uint spheres = 0u;
    bool done;
    do {
        // The nearest node of the group; the others are kept for later.
        if (spheres == 0u && group.count > 0u) {
            uint node = group.first_child + (group.places & 3u);
            group.places >>= 2;
            --group.count;
            stack[height] = packed_group(group);
            height += group.count > 0u ? 1 : 0;
            Entered entered = enter_node(node, ray, in_shadow ? shadow_inverse : inverse,
                                         in_shadow ? shadow.distance : hit.distance);
            group = entered.inner;
            first_place = entered.first_place;
            spheres = entered.spheres;
        }

        // The next sphere.
        if (spheres != 0u) {
            uint place = first_place + uint(findLSB(spheres));
            spheres &= spheres - 1u;
            uint surface = SURFACE_COUNT + place;
            vec4 centre_radius = tree_sphere(place, time);
            if (in_shadow)
                shade_sphere(blocked, start, shadow, surface, centre_radius);
            else
                keep_closer_of_tree(hit, distance_to_sphere(start, direction, surface, centre_radius), surface);
        }

        // What is left of this ray, or the other ray.
        bool is_empty = spheres == 0u && group.count == 0u;
        bool ray_ends = (is_empty && height == 0) || (in_shadow && blocked);
        height -= is_empty && height > 0 ? 1 : 0;
        group = is_empty ? unpacked_group(stack[height]) : group;
        done = ray_ends && !in_shadow;
        if (ray_ends) {
            in_shadow = false;
            group = is_followed ? root : nothing;
            spheres = 0u;
            height = 0;
        }
    } while (!done);
    walk_was_cut = walk_was_cut || !done;
}

#endif
