// The physically-normalised Phong model (shaders/README.md, section 4; Lafortune and Willems 1994).
#ifndef PHONG_GLSL
#define PHONG_GLSL

#include "sampling.glsl"
#include "scene.glsl"
#include "vertex.glsl"

const bool SAMPLE_LOBES = PT_SAMPLES_LOBES;

struct Material {
    vec3 diffuse;               // albedo / pi
    vec3 specular;              // weight times (n + 2) / (2 pi)
    float glossiness;           // n
    float specular_probability; // probability that sample_direction() samples the lobe
};

Material material_of(uint surface)
{
    vec4 diffuse = diffuse_of(surface);
    vec4 specular = specular_of(surface);
    bool choose_lobe = GLOSS == 1u && SAMPLE_LOBES;
    return Material(diffuse.rgb, specular.rgb, specular.a, choose_lobe ? diffuse.a : 0.0);
}

// Minimum probability of the lobe for a path's last direction, if lamps are sampled (shaders/README.md, section 5). The
// minimum is below 1, because lamp sampling misses some light.
const float LAST_SPECULAR_PROBABILITY = 0.97;

Material at_last_direction(Material material)
{
    if (material.specular_probability > 0.0)
        material.specular_probability = at_least(material.specular_probability, LAST_SPECULAR_PROBABILITY);
    return material;
}

// Returns max(0, wo . r)^n = 2^(n log2(1 - y)) with y = |wo - r|^2 / 2. The difference wo - r keeps y precise near r,
// where pow(wo . r, n) has an error of 35% at n = 1e6. For n = 0, 0^0 counts as 0.
float lobe_power(vec3 r, vec3 wo, float n)
{
    vec3 chord = wo - r;
    float y = 0.5 * dot(chord, chord);
    float power = exp2_negative(n * log2_one_minus(y)); // undefined for y >= 1
    return y < 1.0 ? power : 0.0;
}

struct Reflection {
    vec3 f;
    float cosine;  // cosine of the angle to the normal; 0 below the horizon
    float density; // density of sample_direction() over solid angle
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

// Samples the angle to r with density (n + 1) / (2 pi) (wo . r)^n. Returns its cosine and sine.
vec2 lobe_cos_sin(float n, float u)
{
    return narrow_cos_sin(one_minus_exp2(log2_one_minus(u) / (n + 1.0)));
}

// The direction may be below the horizon, where the reflection is 0. reflection() computes the density of the whole
// lobe.
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
