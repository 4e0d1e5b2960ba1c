// Lamps: emitting spheres, chosen by what they can contribute and sampled by the solid angle they subtend. Used by
// path.glsl.
#ifndef LIGHTS_GLSL
#define LIGHTS_GLSL

#include "intersect.glsl"
#include "sampling.glsl"
#include "vertex.glsl"

// A lamp as seen from a vertex.
struct LampView {
    vec3 axis;           // unit direction to the centre
    float distance;      // to the centre
    float radius;
    float one_minus_cos; // of half the angle that the lamp subtends
    float weight;        // in the choice among lamps; 0 where it cannot be sampled
};

// The lamp's weight, times pi, is an upper bound of the irradiance that it can cause: radiance times (r / d)^2 times
// min(1, (n . v + r) / d), which is the cosine to its centre raised by the most that its extent can add. A lamp that
// is partly above the horizon never has weight 0, even if its centre is below. From inside or on the lamp it is not
// sampled; directions find it instead.
LampView view_lamp(Vertex vertex, uint lamp, float time)
{
    vec4 sphere = sphere_among(LAMP_COUNT, lamp, time);
    vec3 to_centre = sphere.xyz - vertex.position;
    float squared_distance = dot(to_centre, to_centre);
    float inverse_distance = inversesqrt(squared_distance);
    float squared_sine = min(sphere.w * sphere.w / squared_distance, 1.0);
    float highest_cosine = min(1.0, (dot(vertex.normal, to_centre) + sphere.w) * inverse_distance);
    bool sampled = squared_sine < 1.0 && highest_cosine > 0.0 && lamp != vertex.surface;

    LampView view;
    view.axis = to_centre * inverse_distance;
    view.distance = squared_distance * inverse_distance;
    view.radius = sphere.w;
    // 1 - cos = sin^2 / (1 + cos): no cancellation for small or far lamps.
    view.one_minus_cos = squared_sine / (1.0 + sqrt(1.0 - squared_sine));
    view.weight = sampled ? emission_of_lamp(lamp).a * squared_sine * highest_cosine : 0.0;
    return view;
}

// The choice among the lamps of a vertex.
struct LampChoice {
    float total_weight;
    float lamp_count; // with a weight above 0
};

LampChoice no_lamp_choice() { return LampChoice(0.0, 0.0); }

LampChoice lamp_choice(Vertex vertex, float time)
{
    LampChoice choice = no_lamp_choice();
    uint lamp = 0u;
    do {
        float weight = view_lamp(vertex, lamp, time).weight;
        choice.total_weight += weight;
        choice.lamp_count += weight > 0.0 ? 1.0 : 0.0;
        ++lamp;
    } while (lamp < LAMP_COUNT);
    return choice;
}

// Share of the choices made uniformly among the lamps in sight, whatever their weights: where the strongest lamp is
// hidden, the weights alone would leave the others to chance. It raises the second moment by a ninth at most where
// nothing is.
const float UNIFORM_SHARE = 0.1;

float lamp_probability(LampChoice choice, float weight)
{
    float probability = (1.0 - UNIFORM_SHARE) * (weight / choice.total_weight) + UNIFORM_SHARE / choice.lamp_count;
    return weight > 0.0 ? (LAMP_COUNT == 1u ? 1.0 : probability) : 0.0;
}

// Density over solid angle of the directions towards a lamp that has been chosen; 0 where it cannot be sampled.
float cone_density(LampView view)
{
    return view.weight > 0.0 ? 1.0 / (2.0 * PI * view.one_minus_cos) : 0.0;
}

struct LampSample {
    ShadowRay shadow;
    float density; // over solid angle, given the lamp; 0: it cannot be sampled from this vertex
};

// Direction uniform in the cone that a lamp subtends, and the distance at which it meets the lamp. That is not found
// by intersection, which a tiny far lamp would survive only by luck: with h = 1 - cos of the angle from the axis, the
// near root is d cos - sqrt(r^2 - d^2 sin^2).
LampSample sample_lamp(LampView view, uint lamp, vec2 u)
{
    float h = u.x * view.one_minus_cos;
    vec3 direction = direction_about(view.axis, narrow_cos_sin(h), u.y);
    float half_chord = sqrt(max(view.radius * view.radius - view.distance * view.distance * h * (2.0 - h), 0.0));
    float distance = view.distance * (1.0 - h) - half_chord;
    float density = cone_density(view);
    return LampSample(ShadowRay(direction, density > 0.0 ? distance : 0.0, lamp), density);
}

// Index of the lamp that a random number chooses with lamp_probability. Its low end chooses uniformly among the lamps
// in sight, the rest by weight: each part walks over its own numbers in the order in which they were summed, so that
// no small probability is lost to rounding. Where rounding leaves the walk short, the last lamp in sight stands.
uint choose_lamp(Vertex vertex, LampChoice choice, float time, float u)
{
    bool uniformly = u < UNIFORM_SHARE;
    float target = uniformly ? u / UNIFORM_SHARE * choice.lamp_count
                             : (u - UNIFORM_SHARE) / (1.0 - UNIFORM_SHARE) * choice.total_weight;
    uint chosen = 0u;
    float cumulated = 0.0;
    uint lamp = 0u;
    do {
        float weight = view_lamp(vertex, lamp, time).weight;
        chosen = cumulated <= target && weight > 0.0 ? lamp : chosen;
        cumulated += uniformly ? (weight > 0.0 ? 1.0 : 0.0) : weight;
        ++lamp;
    } while (lamp < LAMP_COUNT);
    return chosen;
}

#endif
