// The choice of a lamp, by a bound of its contribution.
#ifndef LIGHTS_GLSL
#define LIGHTS_GLSL

#include "lamp.glsl"
#include "lamp_tree.glsl"

// Fraction of choices that are uniform (shaders/README.md, section 6).
const float UNIFORM_SHARE = 0.1;

const bool KEEP_VIEWS = LAMP_COUNT <= EVERY_LAMP_LIMIT;

struct Lamps {
    Vertex vertex;
    float time;
    LampView views[EVERY_LAMP_LIMIT];
    float total_weight;
    float in_sight;        // number of lamps with positive weight
    float share_of_weight;
    float uniform_share; // probability of each lamp in sight if the choice is uniform
    LampTreeTop tree;
};

Lamps lamps_from(Vertex vertex, float time)
{
    Lamps lamps;
    lamps.vertex = vertex;
    lamps.time = time;
    if (HAS_LAMP_TREE) {
        lamps.tree = lamp_tree_top(vertex, time);
        return lamps;
    }
    lamps.total_weight = 0.0;
    lamps.in_sight = 0.0;
    uint lamp = 0u;
    [[unroll]] do {
        LampView view = view_lamp(vertex, lamp, time);
        lamps.total_weight += view.weight;
        lamps.in_sight += view.weight > 0.0 ? 1.0 : 0.0;
        if (KEEP_VIEWS)
            lamps.views[lamp] = view;
        ++lamp;
    } while (lamp < LAMP_COUNT);
    lamps.share_of_weight = (1.0 - UNIFORM_SHARE) / lamps.total_weight;
    lamps.uniform_share = UNIFORM_SHARE / lamps.in_sight;
    return lamps;
}

// lamp may differ between invocations.
LampView lamp_among(Lamps lamps, uint lamp)
{
    if (!KEEP_VIEWS)
        return view_lamp(lamps.vertex, lamp, lamps.time);
    LampView view = lamps.views[0];
    uint i = 1u;
    while (i < LAMP_COUNT) {
        if (lamp == i)
            view = lamps.views[i];
        ++i;
    }
    return view;
}

float lamp_probability(Lamps lamps, float weight)
{
    float probability = weight * lamps.share_of_weight + lamps.uniform_share;
    return weight > 0.0 ? (LAMP_COUNT == 1u ? 1.0 : probability) : 0.0;
}

// Uniform choices take any lamp, because the tree does not count lamps of positive weight.
float lamp_probability_by_tree(LampWalk walk)
{
    precise float probability = (1.0 - UNIFORM_SHARE) * walk.probability + UNIFORM_SHARE / float(LAMP_COUNT);
    return probability;
}

LampChoice choice_of(Lamps lamps, uint lamp)
{
    if (HAS_LAMP_TREE) {
        LampWalk walk = walk_to(lamp);
        walk_down(walk, lamps.tree, lamps.vertex, lamps.time);
        return LampChoice(lamp, view_lamp(lamps.vertex, lamp, lamps.time), lamp_probability_by_tree(walk));
    }
    LampView view = lamp_among(lamps, lamp);
    return LampChoice(lamp, view, lamp_probability(lamps, view.weight));
}

// number is in units of 2^-32. The chosen lamp may have weight 0.
LampChoice choose_by_tree(Lamps lamps, uint number)
{
    const uint uniform_numbers = 429496729u; // UNIFORM_SHARE 2^32
    bool uniformly = number < uniform_numbers;
    uint lamp, low;
    umulExtended(number * 10u, LAMP_COUNT, lamp, low);
    uint rest = number - uniform_numbers;
    LampWalk walk = walk_by(rest + rest / 9u);
    if (uniformly)
        walk = walk_to(lamp);
    lamp = walk_down(walk, lamps.tree, lamps.vertex, lamps.time);
    return LampChoice(lamp, view_lamp(lamps.vertex, lamp, lamps.time), lamp_probability_by_tree(walk));
}

// Numbers below UNIFORM_SHARE choose a lamp of positive weight uniformly. Other numbers choose by weight. Weights are
// summed in the same order as for the total, so that rounding does not suppress small probabilities.
LampChoice choose(Lamps lamps, uint number)
{
    if (HAS_LAMP_TREE)
        return choose_by_tree(lamps, number);
    float u = float(number >> 8u) * NUMBER_STEP;
    bool uniformly = u < UNIFORM_SHARE;
    float target = uniformly ? u * (1.0 / UNIFORM_SHARE) * lamps.in_sight
                             : (u - UNIFORM_SHARE) * (1.0 / (1.0 - UNIFORM_SHARE)) * lamps.total_weight;
    uint chosen = 0u;
    float cumulated = 0.0;
    uint lamp = 0u;
    [[unroll]] do {
        float weight = KEEP_VIEWS ? lamps.views[lamp].weight : view_lamp(lamps.vertex, lamp, lamps.time).weight;
        chosen = cumulated <= target && weight > 0.0 ? lamp : chosen;
        cumulated += uniformly ? (weight > 0.0 ? 1.0 : 0.0) : weight;
        ++lamp;
    } while (lamp < LAMP_COUNT);
    return choice_of(lamps, chosen);
}

#endif
