// The physically-normalised Phong model: value, sampling, density.
//     f = diffuse / pi + specular (n + 2) / (2 pi) max(0, wo . r)^n
// with r the mirror direction (Lafortune and Willems, "Using the Modified Phong Reflectance Model for Physically Based
// Rendering", 1994).
#ifndef PHONG_GLSL
#define PHONG_GLSL

#include "sampling.glsl"
#include "scene.glsl"
#include "vertex.glsl"

// Whether directions follow the specular lobe, where there is one. Otherwise they follow the cosine, or are uniform.
const bool SAMPLE_LOBES = ESTIMATOR != ESTIMATOR_UNIFORM && ESTIMATOR != ESTIMATOR_COSINE;

struct Material {
    vec3 diffuse;               // albedo / pi
    vec3 specular;              // factor times (n + 2) / (2 pi)
    float glossiness;           // n
    float specular_probability; // with which direction sampling chooses the specular lobe
};

Material material_of(uint surface)
{
    vec4 diffuse = diffuse_of(surface);
    vec4 specular = specular_of(surface);
    bool choose_lobe = GLOSS == 1u && SAMPLE_LOBES;
    return Material(diffuse.rgb, specular.rgb, specular.a, choose_lobe ? diffuse.a : 0.0);
}

// The share of the specular lobe in a path's last direction, where lamps are sampled too: that direction finds only
// emission, which lamp sampling finds better for the diffuse lobe. (Error with two vertices, coursework scene: with
// 0.9, 1.6 times less than with the share of other vertices; with 0.97, 0.96 of that; large-lamp and glossy-ladder 0.96
// and 0.98. A share of 1 would be 0.01 better still, but would lose light that lamp sampling cannot find, as from
// within a lamp.)
const float LAST_SPECULAR_PROBABILITY = 0.97;

Material at_last_direction(Material material)
{
    if (material.specular_probability > 0.0)
        material.specular_probability = at_least(material.specular_probability, LAST_SPECULAR_PROBABILITY);
    return material;
}

// max(0, wo . r)^n for unit vectors, where n = 0 stands for the limit: 1 on the half space about r. With y = |wo - r|^2
// / 2 = 1 - wo . r this is 2^(n log2(1 - y)). The chord wo - r gives y with its relative precision however near wo is
// to r, where all of a glossy lobe lies: pow(wo . r, n) is 35% off at n = 1e6.
float lobe_power(vec3 r, vec3 wo, float n)
{
    vec3 chord = wo - r;
    float y = 0.5 * dot(chord, chord);
    float power = exp2_negative(n * log2_one_minus(y)); // any value where there is no lobe
    return y < 1.0 ? power : 0.0;
}

// What a surface does with light in one direction.
struct Reflection {
    vec3 f;
    float cosine;  // of the outgoing direction; 0 below the horizon
    float density; // of choosing that direction by sample_direction, over solid angle
};

Reflection reflection(Material material, Vertex vertex, vec3 outgoing)
{
    float cosine = at_least(dot(vertex.normal, outgoing), 0.0);
    float p = material.specular_probability;
    vec3 f = material.diffuse;
    float density = (1.0 - p) * (1.0 / PI) * cosine;
    if (GLOSS == 1u) {
        float n = material.glossiness;
        float lobe = lobe_power(vertex.mirror, outgoing, n);
        f += material.specular * lobe;
        density += p * (n + 1.0) * (0.5 / PI) * lobe;
    }
    return Reflection(f, cosine, ESTIMATOR == ESTIMATOR_UNIFORM ? 0.5 / PI : density);
}

// Polar angle about the mirror direction r with density (n + 1) / (2 pi) (wo . r)^n: its cosine is
// (1 - u)^(1 / (n + 1)), taken as its distance from 1.
vec2 lobe_cos_sin(float n, float u)
{
    return narrow_cos_sin(one_minus_exp2(log2_one_minus(u) / (n + 1.0)));
}

// The direction in which a path continues. It may lie below the horizon, where its value is 0: to draw again or to
// renormalise the lobe would give it another density than reflection() states.
vec3 sample_direction(Material material, Vertex vertex, vec2 place, float lobe)
{
    if (ESTIMATOR == ESTIMATOR_UNIFORM)
        return uniform_hemisphere_direction(vertex.normal, place);
    vec3 axis = vertex.normal;
    vec2 cos_sin = cosine_hemisphere_cos_sin(place.x);
    if (GLOSS == 1u && SAMPLE_LOBES && lobe < material.specular_probability) {
        axis = vertex.mirror;
        cos_sin = lobe_cos_sin(material.glossiness, place.x);
    }
    return direction_about(axis, cos_sin, place.y);
}

#endif
