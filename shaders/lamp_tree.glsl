#ifndef LAMP_TREE_GLSL
#define LAMP_TREE_GLSL

#include "maths.glsl"
#include "scene.glsl"
#include "vertex.glsl"

const bool HAS_LAMP_TREE = LAMP_TREE_LEVELS > 0u;

struct Siblings {
    vec4 x, y, z;
    vec4 power;  // 0: no node
    vec4 spread; // radius for a lamp
};

Siblings siblings_of(uint group, Vertex vertex, float time)
{
    uint word = LAMP_TREE + lamp_tree_group_words(MOTION) * group;
    vec4 x = stored_word(word);
    vec4 y = stored_word(word + 1u);
    vec4 z = stored_word(word + 2u);
    if (MOTION == 1) {
        x += time * stored_word(word + 5u);
        y += time * stored_word(word + 6u);
        z += time * stored_word(word + 7u);
    }
    return Siblings(x - vertex.position.x, y - vertex.position.y, z - vertex.position.z,
                    stored_word(word + 3u), stored_word(word + 4u));
}

// Probabilities are `precise`, because walk_by() and walk_to() must compute the same bits for a lamp.

// The importance of shaders/README.md, section 6. Below the horizon the quotient `below` avoids cancellation and is
// never 0.
vec4 node_importance(Siblings nodes, vec3 normal)
{
    precise vec4 height = nodes.x * normal.x + nodes.y * normal.y + nodes.z * normal.z;
    precise vec4 squared = nodes.x * nodes.x + nodes.y * nodes.y + nodes.z * nodes.z + 0.5 * nodes.spread;
    precise vec4 inverse = inversesqrt(squared);
    precise vec4 variance = nodes.spread * (1.0 / 3.0);
    precise vec4 above = abs(height) + sqrt(height * height + variance);
    precise vec4 below = variance / above;
    vec4 twice = vec4(height.x < 0.0 ? below.x : above.x, height.y < 0.0 ? below.y : above.y,
                      height.z < 0.0 ? below.z : above.z, height.w < 0.0 ? below.w : above.w);
    precise vec4 importance = nodes.power * inverse * inverse * min(0.5 * twice * inverse, vec4(1.0));
    return importance;
}

// The same weight as in view_lamp().
vec4 lamp_importance(Siblings lamps, vec3 normal)
{
    vec4 radius = lamps.spread;
    precise vec4 height = lamps.x * normal.x + lamps.y * normal.y + lamps.z * normal.z + radius;
    precise vec4 squared = lamps.x * lamps.x + lamps.y * lamps.y + lamps.z * lamps.z;
    precise vec4 inverse = inversesqrt(squared);
    precise vec4 importance = lamps.power * inverse * inverse * min(height * inverse, vec4(1.0));
    precise vec4 outside = min(height, squared - radius * radius);
    return vec4(outside.x > 0.0 ? importance.x : 0.0, outside.y > 0.0 ? importance.y : 0.0,
                outside.z > 0.0 ? importance.z : 0.0, outside.w > 0.0 ? importance.w : 0.0);
}

float sum_of(vec4 importance)
{
    precise float sum = importance.x + importance.y + importance.z + importance.w;
    return sum;
}

struct LampTreeTop {
    vec4 importance[LAMP_TREE_TOP_GROUPS];
};

LampTreeTop lamp_tree_top(Vertex vertex, float time)
{
    const uint groups = lamp_tree_top_groups(LAMP_COUNT, LAMP_TREE_LEVELS);
    LampTreeTop top;
    uint group = 0u;
    [[unroll]] do {
        top.importance[group] =
            group < groups ? node_importance(siblings_of(group, vertex, time), vertex.normal) : vec4(0.0);
        ++group;
    } while (group < LAMP_TREE_TOP_GROUPS);
    return top;
}

// index may differ between invocations.
float component_of(vec4 v, uint index) { return index < 2u ? (index == 0u ? v.x : v.y) : (index == 2u ? v.z : v.w); }

struct LampWalk {
    bool chooses;
    uint slot;
    float u;   // remaining random number
    uint finer;
    float probability;
};

uint lamp_tree_slots()
{
    return LAMP_TREE + lamp_tree_group_words(MOTION) * lamp_tree_groups(LAMP_COUNT, LAMP_TREE_LEVELS);
}

LampWalk walk_to(uint lamp)
{
    const uint slots = lamp_tree_slots() + lamp_tree_slot_groups(LAMP_COUNT, LAMP_TREE_LEVELS);
    return LampWalk(false, stored_index(slots, lamp), 0.0, 0u, 1.0);
}

LampWalk walk_by(uint number) { return LampWalk(true, 0u, float(number >> 8u) * NUMBER_STEP, number, 1.0); }

// Takes one of four children with a probability proportional to `importance` or, if that is 0 for all, to `others`.
// Takes the last child of positive importance for which the sum over earlier children is at most the random number. So
// rounding never chooses a child of importance 0. A choice with probability p removes log2(1 / p) random bits from
// walk.u. A hash replaces them.
uint take_child(inout LampWalk walk, vec4 importance, vec4 others, uint given)
{
    vec4 part = sum_of(importance) > 0.0 ? importance : others;
    precise float two = part.x + part.y;
    precise float three = two + part.z;
    precise float total = three + part.w;
    float target = walk.u * total;
    uint child = target >= part.x && part.y > 0.0 ? 1u : 0u;
    child = target >= two && part.z > 0.0 ? 2u : child;
    child = target >= three && part.w > 0.0 ? 3u : child;
    child = walk.chooses ? child : given;
    float own = component_of(part, child);
    float before = component_of(vec4(0.0, part.x, two, three), child);
    walk.finer = walk.finer * 747796405u + 2891336453u;
    float fill = float(walk.finer >> 8u) * (NUMBER_STEP * NUMBER_STEP);
    walk.u = clamp((target - before + fill * total) / own, 0.0, LARGEST_NUMBER);
    precise float probability = walk.probability * (own / total);
    walk.probability = probability;
    return child;
}

uint walk_down(inout LampWalk walk, LampTreeTop top, Vertex vertex, float time)
{
    const uint groups = lamp_tree_top_groups(LAMP_COUNT, LAMP_TREE_LEVELS);
    const vec4 even = vec4(1.0);
    uint shift = 2u * LAMP_TREE_LEVELS;
    vec4 sums = vec4(sum_of(top.importance[0]), sum_of(top.importance[1]), sum_of(top.importance[2]),
                     sum_of(top.importance[3]));
    vec4 all_groups = vec4(1.0, groups > 1u ? 1.0 : 0.0, groups > 2u ? 1.0 : 0.0, groups > 3u ? 1.0 : 0.0);
    uint node = take_child(walk, sums, all_groups, walk.slot >> (shift + 2u));
    vec4 importance = node < 2u ? (node == 0u ? top.importance[0] : top.importance[1])
                                : (node == 2u ? top.importance[2] : top.importance[3]);
    node = 4u * node + take_child(walk, importance, even, (walk.slot >> shift) & 3u);
    uint first = groups; // first group of the next level
    uint count = 4u * groups;
    if (LAMP_TREE_LEVELS > 1u) {
        uint level = 1u;
        [[dont_unroll]] do {
            shift -= 2u;
            importance = node_importance(siblings_of(first + node, vertex, time), vertex.normal);
            node = 4u * node + take_child(walk, importance, even, (walk.slot >> shift) & 3u);
            first += count;
            count *= 4u;
            ++level;
        } while (level < LAMP_TREE_LEVELS);
    }
    Siblings lamps = siblings_of(first + node, vertex, time);
    vec4 there = vec4(greaterThan(lamps.power, vec4(0.0)));
    uint slot = 4u * node + take_child(walk, lamp_importance(lamps, vertex.normal), there, walk.slot & 3u);
    return stored_index(lamp_tree_slots(), slot);
}

#endif
