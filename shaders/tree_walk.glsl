// Intersects rays with tree spheres. The hit has the same bits as if all spheres were tested (shaders/README.md,
// section 3).
#ifndef TREE_WALK_GLSL
#define TREE_WALK_GLSL

#include "ray_tests.glsl"
#include "tree_node.glsl"

// GridRay.advance is rounded by 2^-24, so a farther sphere may get the same distance as a nearer one. To find both,
// boxes are entered up to 2^-22 of the advance beyond the hit.
const float ADVANCE_ROUNDED = 0.99999976; // 1 - 2^-22

// The word of surfaces outside the tree, which sorts before every tree sphere.
const uvec4 NO_SPHERE_WORD = uvec4(0u, 0u, 0u, ~0u);

// Order at equal distances (shaders/README.md, section 3). Slots decide between spheres that differ only in motion.
bool goes_before(uvec4 word, uint surface, uvec4 other_word, uint other_surface)
{
    return word.x != other_word.x   ? word.x < other_word.x
           : word.y != other_word.y ? word.y < other_word.y
           : word.z != other_word.z ? word.z < other_word.z
           : word.w != other_word.w ? word.w > other_word.w
                                    : surface < other_surface;
}

void keep_closer_of_tree(inout Hit hit, inout uvec4 hit_word, float distance, uint surface, uvec4 word)
{
    bool as_close = distance == hit.distance && distance < NO_HIT;
    bool closer = distance < hit.distance || (as_close && goes_before(word, surface, hit_word, hit.surface));
    hit.distance = closer ? distance : hit.distance;
    hit.surface = closer ? surface : hit.surface;
    hit_word = closer ? word : hit_word;
}

// ball is relative to the ray's start.
float distance_in_tree(Start start, GridRay ray, vec3 direction, uint surface, Ball ball, float time)
{
    bool leaving = surface == start.surface;
    vec3 to_first = ball.center_radius.xyz;
    if (TREE_INSIDE == 0) {
        vec3 to_center = to_met(ball, to_first, direction, false, TREE_KINDS);
        return ray.advance + distance_from_outside(to_center, ball.center_radius.w, direction, leaving);
    }
    vec3 from_side = KNOWN_SIDES == 1 ? tree_ball(surface - SURFACE_COUNT, time).center_radius.xyz : to_first;
    return ray.advance +
           ball_distance(ball, to_first, from_side, direction, leaving, start.inside, rounding_of(start), TREE_KINDS);
}

// At equal distances a lamp outside the tree goes before tree spheres.
bool blocks_in_tree(Start start, GridRay ray, ShadowRay shadow, vec3 direction, float distance, uint surface,
                    uvec4 word, Ball ball)
{
    if (INSIDE == 1 || CLOSE_LAMPS == 1) {
        bool before = distance < shadow.distance;
        if (CLOSE_LAMPS == 1 && TREE_LAMPS > 0u && distance == shadow.distance && shadow.lamp >= SURFACE_COUNT)
            before = goes_before(word, surface, tree_sphere_word(shadow.lamp - SURFACE_COUNT), shadow.lamp);
        return before && surface != shadow.lamp;
    }
    bool at_end = surface == start.surface || surface == shadow.lamp;
    return ball_blocks(ball, ball.center_radius.xyz, direction, at_end, shadow.distance - ray.advance, TREE_KINDS);
}

ShadowRay ended_as_met_in_tree(ShadowRay shadow, Start start, float time)
{
    if (CLOSE_LAMPS == 1 && TREE_LAMPS > 0u && shadow.distance > 0.0 && shadow.lamp >= SURFACE_COUNT) {
        GridRay ray = grid_ray(start.origin, shadow.direction);
        uint place = shadow.lamp - SURFACE_COUNT;
        Ball ball = tree_ball_from(tree_sphere_word(place), ray.base, ray.rest, place, time);
        float distance = distance_in_tree(start, ray, shadow.direction, shadow.lamp, ball, time);
        shadow.distance = distance < NO_HIT ? distance : shadow.distance;
    }
    return shadow;
}

// A walk traces the vertex's shadow ray, if there is one, and then the path's ray. The walk changes to the path's ray
// as soon as the shadow ray is blocked.
struct Walk {
    Start start;
    vec3 direction;
    ShadowRay shadow;
    float time;
    uint opacity_number;
    Hit hit;      // initially the closest surface outside the tree
    bool blocked; // whether the shadow ray is blocked; initially only by surfaces outside the tree
    uvec4 hit_word;
    GridRay path_ray;
    GridRay shadow_ray;
    vec3 path_inverse;
    vec3 shadow_inverse;
    bool follows_path;
    bool seeks_light; // only emission counts at the hit, so without lamps in the tree any tree sphere ends the ray
    bool in_shadow;
    uint node;
    uint first_place; // slot of the last node's first child sphere
    uint spheres;
    int height; // stack height, or ENDED
    bool done;
};

// On lavapipe, invocations run in lockstep, because all execute every branch of the code.
const bool IN_STEP = WALK_TRIPS == 0u;

// Groups to be entered. The stack is outside Walk, because functions copy arguments. lavapipe handles accesses with
// variable indices one invocation at a time. So with IN_STEP all indices are constant, and the last group is at 0.
const uint STACK_SIZE = TREE_LEVELS > 0u ? TREE_LEVELS : 1u;
uint walk_stack[STACK_SIZE];

// Value of Walk.height after a complete walk. A driver may end the loop in go_on() early, but compilers assume that
// `done` is true after it. Only the height shows that the walk is incomplete.
const int ENDED = -1;

const uint ROOT = 0u;

Walk walk_from(Start start, vec3 direction, bool is_followed, ShadowRay shadow, float time, uint opacity_number,
               Hit hit, bool blocked)
{
    Walk walk;
    walk.start = start;
    walk.direction = direction;
    walk.shadow = shadow;
    walk.time = time;
    walk.opacity_number = opacity_number;
    walk.hit = hit;
    walk.blocked = blocked;
    walk.seeks_light = false;
    walk.done = true;
    if (TREE == 0u)
        return walk;
    walk.hit_word = NO_SPHERE_WORD;
    walk.path_ray = grid_ray(start.origin, direction);
    walk.shadow_ray = grid_ray(start.origin, shadow.direction);
    walk.path_inverse = inverse_of(direction);
    walk.shadow_inverse = inverse_of(shadow.direction);
    walk.follows_path = is_followed && walk.path_ray.is_near;
    walk.in_shadow = shadow.distance > 0.0 && !blocked && walk.shadow_ray.is_near;
    walk.done = !walk.in_shadow && !walk.follows_path;
    walk.node = walk.done ? NO_NODE : ROOT;
    walk.first_place = 0u;
    walk.spheres = 0u;
    walk.height = walk.done ? ENDED : 0;
    return walk;
}

void keep_or_take(inout Walk walk, bool keeps, uint group)
{
    uint last = walk_stack[0];
    bool takes = walk.node == NO_NODE && walk.height > 0;
    bool removes = takes && has_one(last);
    walk.node = takes ? next_of(last) : walk.node;
    walk_stack[0] = takes ? without_next(last) : last;
    uint above = group;
    uint i = 0u;
    [[unroll]] do {
        uint own = walk_stack[i];
        uint below = i + 1u < STACK_SIZE ? walk_stack[min(i + 1u, STACK_SIZE - 1u)] : own;
        walk_stack[i] = keeps ? above : removes ? below : own;
        above = own;
        ++i;
    } while (i < STACK_SIZE);
    walk.height += (keeps ? 1 : 0) - (removes ? 1 : 0);
}

void keep(inout Walk walk, uint group)
{
    walk_stack[walk.height] = group;
    ++walk.height;
}

void take(inout Walk walk)
{
    uint last = walk_stack[walk.height - 1];
    walk.node = next_of(last);
    walk_stack[walk.height - 1] = without_next(last);
    walk.height -= has_one(last) ? 1 : 0;
}

GridRay ray_of(Walk walk, bool in_shadow)
{
    GridRay ray = walk.path_ray;
    if (in_shadow)
        ray = walk.shadow_ray;
    return ray;
}

Entered enter(Walk walk, NodeWords words, GridRay ray, bool in_shadow)
{
    vec3 inverse = in_shadow ? walk.shadow_inverse : walk.path_inverse;
    float before = in_shadow ? walk.shadow.distance : walk.hit.distance;
    return enter_node(words, ray, inverse, before - ray.advance * ADVANCE_ROUNDED);
}

uint next_place(inout Walk walk)
{
    uint place = walk.first_place + uint(findLSB(walk.spheres));
    walk.spheres &= walk.spheres - 1u;
    return place;
}

bool is_in_tree(uint surface) { return surface >= SURFACE_COUNT && surface != NO_SURFACE; }

// Returns an odd hash of a sphere's word. Translucent spheres have different words (lib/tree/coincident_spheres.h). The
// radius is in grid steps, so the hash does not depend on the scene's scale. The hash ends like lowbias32 (Wellons,
// "Prospecting for hash functions", 2018).
uint opacity_generator(uvec4 word, uint opacity_number)
{
    uint change = (opacity_number & TREE_OPACITY_BITS) << 1u;
    uint radius = word.w - floatBitsToUint(tree_step());
    uint hash = (word.x ^ radius) * 0x9e3779b1u;
    hash = (hash ^ (hash >> 15u) ^ word.y) * 0x85ebca77u;
    hash = (hash ^ (hash >> 13u) ^ word.z) * (0xc2b2ae3du ^ change);
    hash = (hash ^ (hash >> 16u)) * (0x7feb352du ^ change);
    return hash ^ (hash >> 16u) | 1u;
}

// Whether a ray passes a sphere, at random (Enderton et al. 2010). The result depends only on the sphere and
// opacity_number, not on the order of tests.
bool passes(uvec4 word, uint opacity_number)
{
    if (TREE_OPACITY == 0)
        return false;
    uint number = opacity_generator(word, opacity_number) * opacity_number;
    const float steps = float(TREE_OPACITY_STEPS) / 16777216.0; // exact in a float
    return float(number >> 8u) * steps >= float(word.w & TREE_OPACITY_STEPS);
}

void test_sphere(inout Walk walk, bool exists, uint place, uvec4 word, GridRay ray, bool in_shadow)
{
    uint surface = SURFACE_COUNT + place;
    Ball ball = tree_ball_from(word, ray.base, ray.rest, place, walk.time);
    vec3 direction = in_shadow ? walk.shadow.direction : walk.direction;
    float distance = distance_in_tree(walk.start, ray, direction, surface, ball, walk.time);
    bool between = blocks_in_tree(walk.start, ray, walk.shadow, direction, distance, surface, word, ball);
    bool meets = exists;
    if (TREE_OPACITY == 1)
        meets = exists && !passes(word, walk.opacity_number);
    walk.blocked = walk.blocked || (in_shadow && meets && between);
    keep_closer_of_tree(walk.hit, walk.hit_word, meets && !in_shadow ? distance : NO_HIT, surface, word);
}

// Enters at most one node and tests at most one sphere of an earlier node. Both are fetched together, because lavapipe
// 22.3 spills registers around each fetch.
void trip_in_step(inout Walk walk, bool in_shadow)
{
    bool tests = walk.spheres != 0u;
    uint place = tests ? next_place(walk) : 0u;
    bool enters = walk.spheres == 0u && walk.node != NO_NODE;
    uvec4 word = tree_sphere_word(place);
    NodeWords words = node_words(enters ? walk.node : ROOT);
    GridRay ray = ray_of(walk, in_shadow);
    Entered entered = enter(walk, words, ray, in_shadow);
    walk.node = enters ? entered.node : walk.node;
    walk.first_place = enters ? entered.first_place : walk.first_place;
    walk.spheres = enters ? entered.spheres : walk.spheres;
    keep_or_take(walk, enters && entered.has_others, entered.others);
    test_sphere(walk, tests, place, word, ray, in_shadow);
}

// The next node is taken after the sphere's test, which is faster on GPUs.
void trip(inout Walk walk, bool in_shadow)
{
    GridRay ray = ray_of(walk, in_shadow);
    if (walk.spheres == 0u && walk.node != NO_NODE) {
        Entered entered = enter(walk, node_words(walk.node), ray, in_shadow);
        walk.node = entered.node;
        walk.first_place = entered.first_place;
        walk.spheres = entered.spheres;
        if (entered.has_others)
            keep(walk, entered.others);
    }
    if (walk.spheres != 0u) {
        uint place = next_place(walk);
        test_sphere(walk, true, place, tree_sphere_word(place), ray, in_shadow);
    }
    if (walk.node == NO_NODE && walk.height > 0)
        take(walk);
}

// Continues until the walk is done or, without IN_STEP, for at most most_trips.
void go_on(inout Walk walk, uint most_trips, bool has_shadow)
{
    uint trips = 0u;
    do {
        bool in_shadow = has_shadow && walk.in_shadow;
        if (IN_STEP)
            trip_in_step(walk, in_shadow);
        else
            trip(walk, in_shadow);

        bool ray_ends = walk.spheres == 0u && walk.node == NO_NODE;
        if (in_shadow)
            ray_ends = ray_ends || walk.blocked;
        else if (TREE_LAMPS == 0u)
            ray_ends = ray_ends || (walk.seeks_light && is_in_tree(walk.hit.surface));
        if (ray_ends) {
            walk.done = walk.done || !in_shadow || !walk.follows_path;
            walk.in_shadow = false;
            walk.node = walk.done ? NO_NODE : ROOT;
            walk.spheres = 0u;
            walk.height = walk.done ? ENDED : 0;
        }
        ++trips;
    } while (!walk.done && (IN_STEP || trips < most_trips));
}

// A driver that limits loops has ended a walk early; the sample is lost.
bool walk_was_cut = false;

void finish(inout Walk walk, bool has_shadow)
{
    if (TREE == 0u)
        return;
    go_on(walk, 0xffffffffu, has_shadow);
    walk_was_cut = walk_was_cut || walk.height != ENDED;
}

#endif
