// One lamp: the bound of its contribution, a sample, and the sample's density. Lamps are emitting spheres, sampled by
// solid angle.
#ifndef LAMP_GLSL
#define LAMP_GLSL

#include "intersect.glsl"
#include "sampling.glsl"
#include "vertex.glsl"

struct LampView {
    vec3 to_center;
    float squared_distance;
    float inverse_distance;
    float squared_radius;
    float squared_sine; // squared sine of the lamp's angular radius; 1 inside the lamp
    float weight;       // weight in the choice of a lamp; 0: cannot be sampled
};

// The weight of shaders/README.md, section 6. A lamp that contains or touches the vertex gets weight 0.
LampView view_lamp(Vertex vertex, uint lamp, float time)
{
    vec4 sphere = bound_of_lamp(lamp, time);
    LampView view;
    view.to_center = sphere.xyz - vertex.position;
    view.squared_radius = sphere.w * sphere.w;
    view.squared_distance = dot(view.to_center, view.to_center);
    view.inverse_distance = inversesqrt(view.squared_distance);
    view.squared_sine = at_most(view.squared_radius / view.squared_distance, 1.0);
    float highest_cosine = at_most((dot(vertex.normal, view.to_center) + sphere.w) * view.inverse_distance, 1.0);
    bool sampled = view.squared_sine < 1.0 && highest_cosine > 0.0 && surface_of_lamp(lamp) != vertex.surface;
    view.weight = sampled ? emission_of_lamp(lamp).a * view.squared_sine * highest_cosine : 0.0;
    return view;
}

struct LampChoice {
    uint lamp;
    LampView view;
    float probability;
};

float one_minus_cos(LampView view)
{
    return view.squared_sine / (1.0 + sqrt(1.0 - view.squared_sine));
}

// Density over solid angle of a chosen lamp's sample, 1 / (2 pi (1 - cos)).
float cone_density(LampView view)
{
    float density = (0.5 / PI) * (1.0 + sqrt(1.0 - view.squared_sine)) / view.squared_sine;
    return view.weight > 0.0 ? density : 0.0;
}

struct LampSample {
    ShadowRay shadow;
    float density; // density over solid angle for this lamp; 0: cannot be sampled
};

// Samples a direction uniformly in the lamp's cone, with h = 1 - cos of the angle to its axis. The distance is computed
// from h, because an intersection test would miss tiny far lamps by rounding.
LampSample sample_lamp(LampChoice choice, vec2 u)
{
    LampView view = choice.view;
    float h = u.x * one_minus_cos(view);
    vec3 direction = direction_about(view.to_center * view.inverse_distance, narrow_cos_sin(h), u.y);
    float half_chord = sqrt(at_least(view.squared_radius - view.squared_distance * (h * (2.0 - h)), 0.0));
    float distance = view.squared_distance * view.inverse_distance * (1.0 - h) - half_chord;
    float density = cone_density(view);
    return LampSample(ShadowRay(direction, density > 0.0 ? distance : 0.0, surface_of_lamp(choice.lamp)), density);
}

#endif
