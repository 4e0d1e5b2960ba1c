// One path: the light that a sample carries to its pixel. Used by pathtrace.comp.
#ifndef PATH_GLSL
#define PATH_GLSL

#include "camera.glsl"
#include "intersect.glsl"
#include "lights.glsl"
#include "phong.glsl"
#include "random.glsl"
#include "vertex.glsl"

// Lamps are sampled where there are any and the estimator does so.
const bool SAMPLE_LAMPS = ESTIMATOR == ESTIMATOR_MIS && LAMP_COUNT > 0u;

// Light that a direction finds on a surface: weighted against lamp sampling if that could have found it from the vertex too.
vec3 found_emission(Vertex from, LampChoice choice, float density, uint surface, float time)
{
    vec3 emission = emission_of(surface).rgb;
    if (SAMPLE_LAMPS && surface < LAMP_COUNT)
        emission *= power_heuristic(density, lamp_density(choice, view_lamp(from, surface, time)));
    return emission;
}

// Radiance of the path of one sample, an estimate of what the pixel sees: emission plus throughput-weighted light at each
// of up to MAX_PATH_LENGTH vertices.
vec3 path_radiance(FrameConstants frame, uvec2 pixel, SampleKey key)
{
    // The camera ray, spread over the pixel's square (box filter), and what it meets.
    vec4 u = random_4d(key, BLOCK_CAMERA);
    float time = u.z;
    vec3 direction = camera_direction(frame, pixel, u.xy);
    Hit hit = closest_hit(vec3(0.0), direction, time);
    bool alive = hit.surface != NO_SURFACE;
    uint surface = alive ? hit.surface : 0u;
    vec3 radiance = alive ? emission_of(surface).rgb : vec3(0.0);

    if (MAX_PATH_LENGTH > 1u && alive) {
        Vertex vertex = vertex_at(vec3(0.0), direction, hit.distance, surface, time);
        vec3 throughput = vec3(1.0);
        uint length = 1u; // vertices so far
        do {
            Material material = material_of(vertex.surface);

            // A direction towards a lamp, and the light it would bring.
            LampChoice choice = LampChoice(0.0, 0.0);
            ShadowRay shadow = ShadowRay(vec3(0.0), 0.0, NO_SURFACE);
            vec3 lamp_light = vec3(0.0);
            if (SAMPLE_LAMPS) {
                choice = lamp_choice(vertex, time);
                LampSample lamp = sample_lamp(vertex, choice, time, random_4d(key, lamp_block(length)).xyz);
                Reflection towards = reflection(material, vertex, lamp.shadow.direction);
                float weight = lamp.density > 0.0 ? power_heuristic(lamp.density, towards.density) / lamp.density : 0.0;
                lamp_light = throughput * towards.value * emission_of(lamp.shadow.lamp).rgb * weight;
                shadow = lamp.shadow;
            }

            // The direction in which the path goes on.
            direction = sample_direction(material, vertex, random_4d(key, direction_block(length)).xyz);
            Reflection onwards = reflection(material, vertex, direction);
            throughput *= onwards.density > 0.0 ? onwards.value / onwards.density : vec3(0.0);

            // Both rays at once; the lamp's light arrives if nothing is in between.
            bool blocked;
            hit = closest_hit_and_shadow(vertex.position, vertex.surface, time, direction, shadow, blocked);
            radiance += blocked ? vec3(0.0) : lamp_light;

            // The next vertex and what it emits.
            alive = hit.surface != NO_SURFACE && max(throughput.r, max(throughput.g, throughput.b)) > 0.0;
            if (alive) {
                radiance += throughput * found_emission(vertex, choice, onwards.density, hit.surface, time);
                vertex = vertex_at(vertex.position, direction, hit.distance, hit.surface, time);
            }
            ++length;
        } while (alive && length < MAX_PATH_LENGTH);
    }
    return radiance;
}

#endif
