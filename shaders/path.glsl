// One path: the light that a sample carries to its pixel. Used by pathtrace.comp.
#ifndef PATH_GLSL
#define PATH_GLSL

#include "camera.glsl"
#include "dimensions.glsl"
#include "intersect.glsl"
#include "lights.glsl"
#include "phong.glsl"
#include "vertex.glsl"

// Lamps are sampled where there are any and the estimator does so: every one at each vertex, if they are few, else one.
const bool SAMPLE_LAMPS = (ESTIMATOR == ESTIMATOR_MIS || ESTIMATOR == ESTIMATOR_LIGHT) && LAMP_COUNT > 0u;
const bool SAMPLE_EVERY_LAMP = SAMPLE_LAMPS && LAMP_COUNT <= EVERY_LAMP_LIMIT;

struct Path {
    Vertex vertex;
    vec3 throughput;
    vec3 radiance;
    uint vertex_count; // so far
    bool alive;  // whether it may go on from its vertex
};

// Weight of light that lamp sampling found, and of light that a direction found, where both could have: by multiple
// importance sampling, or all to the lamps.
float lamp_weight_against(float lamp_density, float direction_density)
{
    return ESTIMATOR == ESTIMATOR_LIGHT ? 1.0 : power_heuristic(lamp_density, direction_density);
}

float direction_weight_against(float direction_density, float lamp_density)
{
    if (ESTIMATOR == ESTIMATOR_LIGHT)
        return lamp_density > 0.0 ? 0.0 : 1.0;
    return power_heuristic(direction_density, lamp_density);
}

// Light of a lamp that a sample of it would bring if nothing is in between, where the lamp is chosen with a
// probability.
vec3 light_of_lamp(Path path, Material material, LampSample lamp, float probability)
{
    Reflection towards = reflection(material, path.vertex, lamp.shadow.direction);
    float density = lamp.density * probability;
    if (!(density > 0.0))
        return vec3(0.0);
    float weight = lamp_weight_against(density, towards.density) / density;
    return path.throughput * towards.value * emission_of(lamp.shadow.lamp).rgb * weight;
}

// Takes the path one vertex further, with the light that the vertex it leaves gets from lamps.
void extend(inout Path path, SampleKey key, float time)
{
    Vertex vertex = path.vertex;
    Material material = material_of(vertex.surface);
    if (SAMPLE_LAMPS && path.vertex_count + 1u == MAX_PATH_LENGTH)
        material = at_last_direction(material);
    Start start = Start(vertex.position, vertex.surface, vertex.inside);

    // A direction towards a lamp, and the light it would bring. Of every lamp, those after the first have their own
    // walk over the scene; the first, and a chosen one, share that of the path's next ray.
    LampChoice choice = LampChoice(0.0, 0.0);
    ShadowRay shadow = ShadowRay(vec3(0.0), 0.0, NO_SURFACE);
    vec3 lamp_light = vec3(0.0);
    if (SAMPLE_EVERY_LAMP) {
        LampSample lamp = sample_lamp(view_lamp(vertex, 0u, time), 0u, every_lamp_numbers(key, path.vertex_count, 0u));
        lamp_light = light_of_lamp(path, material, lamp, 1.0);
        shadow = lamp.shadow;
        if (LAMP_COUNT > 1u) {
            uint i = 1u;
            [[unroll]] do {
                vec2 place = every_lamp_numbers(key, path.vertex_count, i);
                LampSample further = sample_lamp(view_lamp(vertex, i, time), i, place);
                vec3 light = light_of_lamp(path, material, further, 1.0);
                path.radiance += is_blocked(start, time, further.shadow) ? vec3(0.0) : light;
                ++i;
            } while (i < LAMP_COUNT);
        }
    } else if (SAMPLE_LAMPS) {
        choice = lamp_choice(vertex, time);
        vec3 numbers = chosen_lamp_numbers(key, path.vertex_count);
        uint chosen = choose_lamp(vertex, choice, time, numbers.z);
        LampView view = view_lamp(vertex, chosen, time);
        LampSample lamp = sample_lamp(view, chosen, numbers.xy);
        lamp_light = light_of_lamp(path, material, lamp, lamp_probability(choice, view.weight));
        shadow = lamp.shadow;
    }

    // The direction in which the path goes on.
    vec4 numbers = direction_numbers(key, path.vertex_count);
    vec3 direction = sample_direction(material, vertex, numbers.xy, numbers.z);
    Reflection onwards = reflection(material, vertex, direction);
    path.throughput *= onwards.density > 0.0 ? onwards.value / onwards.density : vec3(0.0);

    // Both rays at once; the lamp's light arrives if nothing is in between.
    bool blocked;
    Hit hit = closest_hit_and_shadow(start, time, direction, shadow, blocked);
    path.radiance += blocked ? vec3(0.0) : lamp_light;

    // The next vertex and what it emits, weighted against lamp sampling if that could have found it too.
    float strongest = max(path.throughput.r, max(path.throughput.g, path.throughput.b));
    path.alive = hit.surface != NO_SURFACE && !(strongest <= 0.0); // what is not a number goes on, to be rejected
    if (path.alive) {
        float weight = 1.0;
        if (SAMPLE_LAMPS && hit.surface < LAMP_COUNT) {
            LampView view = view_lamp(vertex, hit.surface, time);
            float probability = SAMPLE_EVERY_LAMP ? 1.0 : lamp_probability(choice, view.weight);
            weight = direction_weight_against(onwards.density, cone_density(view) * probability);
        }
        path.radiance += path.throughput * emission_of(hit.surface).rgb * weight;
        path.vertex = vertex_at(vertex.position, direction, hit.distance, hit.surface, time);
    }
    ++path.vertex_count;

    // Russian roulette for paths that may get long: from the fourth vertex on a path survives with the probability of
    // its throughput, and if it does, is weighted up by it. The floor bounds the weight: random numbers are multiples
    // of 2^-24, which would be too coarse for tiny probabilities.
    if (ROULETTE && path.vertex_count >= 4u) {
        float survival = clamp(strongest, 0.05, 1.0);
        path.alive = path.alive && numbers.w < survival;
        path.throughput /= survival;
    }
}

// Radiance of the path of one sample, an estimate of what the pixel sees: emission plus throughput-weighted light at
// each of up to MAX_PATH_LENGTH vertices.
vec3 path_radiance(FrameConstants frame, uvec2 pixel, SampleKey key)
{
    // The camera ray, spread over the pixel's square (box filter), and what it meets.
    vec3 numbers = camera_numbers(key);
    float time = numbers.z;
    vec3 direction = camera_direction(frame, pixel, numbers.xy);
    Hit hit = closest_hit(direction, time);
    Path path;
    path.alive = hit.surface != NO_SURFACE;
    uint surface = path.alive ? hit.surface : 0u;
    path.radiance = path.alive ? emission_of(surface).rgb : vec3(0.0);

    if (MAX_PATH_LENGTH > 1u && path.alive) {
        path.vertex = vertex_at(vec3(0.0), direction, hit.distance, surface, time);
        path.throughput = vec3(1.0);
        path.vertex_count = 1u;
        do {
            extend(path, key, time);
        } while (path.alive && path.vertex_count < MAX_PATH_LENGTH);
    }
    return path.radiance;
}

#endif
