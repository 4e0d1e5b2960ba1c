// One path: the light that a sample carries to its pixel. Used by pathtrace.comp.
#ifndef PATH_GLSL
#define PATH_GLSL

#include "camera.glsl"
#include "dimensions.glsl"
#include "intersect.glsl"
#include "lights.glsl"
#include "phong.glsl"
#include "vertex.glsl"

// Lamps are sampled where there are any and the estimator does so: at the first vertex every one of a few, else and at
// others one that is chosen.
const bool SAMPLE_LAMPS = (ESTIMATOR == ESTIMATOR_MIS || ESTIMATOR == ESTIMATOR_LIGHT) && LAMP_COUNT > 0u;
const bool SAMPLE_EVERY_LAMP = SAMPLE_LAMPS && LAMP_COUNT <= EVERY_LAMP_LIMIT;
const bool SAMPLE_ONE_LAMP = SAMPLE_LAMPS && LAMP_COUNT > EVERY_LAMP_LIMIT;

struct Path {
    Vertex vertex;
    vec3 throughput;
    vec3 radiance;
    uint vertex_count; // so far
    bool alive;        // whether it may go on from its vertex
};

// Weight of light that lamp sampling found, and of light that a direction found, where both could have: by multiple
// importance sampling, or all to the lamps. A density here is that of one sample times the number of such samples
// that the vertex takes (Veach 1997, section 9.2.2).
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

// A sample of a lamp: its shadow ray and the light that it brings if nothing is in between.
struct LampLight {
    ShadowRay shadow;
    vec3 light;
};

LampLight no_lamp_light()
{
    return LampLight(ShadowRay(vec3(0.0), 0.0, NO_SURFACE), vec3(0.0));
}

// Light of a lamp of which a vertex takes a number of samples, directions being taken so often at the same vertex.
LampLight light_of_lamp(Path path, Material material, LampView view, uint lamp, vec2 place, float samples,
                        float directions)
{
    LampSample found = sample_lamp(view, lamp, place);
    LampLight result = LampLight(found.shadow, vec3(0.0));
    float density = found.density * samples;
    if (density > 0.0) {
        Reflection towards = reflection(material, path.vertex, found.shadow.direction);
        float weight = lamp_weight_against(density, towards.density * directions) / density;
        result.light = path.throughput * towards.value * emission_of_lamp(lamp).rgb * weight;
    }
    return result;
}

// How often a vertex samples a lamp: each of a few once, else as often as it chooses it.
float lamp_samples(LampChoice choice, LampView view, bool every_lamp, float directions)
{
    return every_lamp ? 1.0 : lamp_probability(choice, view.weight) * directions;
}

// Light of one lamp, chosen by what it can contribute, once for each direction that the vertex takes.
LampLight light_of_chosen_lamp(Path path, Material material, LampChoice choice, float time, vec3 numbers,
                               float directions)
{
    uint chosen = choose_lamp(path.vertex, choice, time, numbers.z);
    LampView view = view_lamp(path.vertex, chosen, time);
    float samples = lamp_samples(choice, view, false, directions);
    return light_of_lamp(path, material, view, chosen, numbers.xy, samples, directions);
}

// Takes the path to its next vertex in one of the directions in which its vertex is left, with the light of a lamp.
void leave(inout Path path, Material material, LampLight lamp, LampChoice choice, bool every_lamp, float time,
           vec4 numbers, float directions)
{
    // The direction in which the path goes on.
    Vertex vertex = path.vertex;
    vec3 direction = sample_direction(material, vertex, numbers.xy, numbers.z);
    Reflection onwards = reflection(material, vertex, direction);
    float density = onwards.density * directions;
    path.throughput *= density > 0.0 ? onwards.value / density : vec3(0.0);

    // Its ray and the lamp's at once; the lamp's light arrives if nothing is in between.
    bool blocked;
    Start start = Start(vertex.position, vertex.surface, vertex.inside);
    Hit hit = closest_hit_and_shadow(start, time, direction, lamp.shadow, blocked);
    path.radiance += blocked ? vec3(0.0) : lamp.light;

    // The next vertex and what it emits, weighted against lamp sampling if that could have found it too.
    float strongest = max(path.throughput.r, max(path.throughput.g, path.throughput.b));
    path.alive = hit.surface != NO_SURFACE && !(strongest <= 0.0); // what is not a number goes on, to be rejected
    if (path.alive) {
        float weight = 1.0;
        if (SAMPLE_LAMPS && hit.surface < LAMP_COUNT) {
            LampView view = view_lamp(vertex, hit.surface, time);
            float samples = lamp_samples(choice, view, every_lamp, directions);
            weight = direction_weight_against(density, cone_density(view) * samples);
        }
        path.radiance += path.throughput * emission_of(hit.surface).rgb * weight;
        path.vertex = vertex_at(vertex.position, direction, hit.distance, hit.surface, time);
    }
    ++path.vertex_count;

    // Russian roulette for paths that may get long: from the fourth vertex on a path survives with the probability of
    // its throughput, as a share of the branch's, and if it does, is weighted up by it. The floor bounds the weight:
    // random numbers are multiples of 2^-24, which would be too coarse for tiny probabilities.
    if (ROULETTE && path.vertex_count >= 4u) {
        float survival = clamp(strongest * float(BRANCH_COUNT), 0.05, 1.0);
        path.alive = path.alive && numbers.w < survival;
        path.throughput /= survival;
    }
}

// The material of the path's vertex, as the direction in which it goes on is to be sampled.
Material material_to_leave(Path path)
{
    Material material = material_of(path.vertex.surface);
    bool last = path.vertex_count + 1u == MAX_PATH_LENGTH;
    return SAMPLE_LAMPS && last ? at_last_direction(material) : material;
}

// Takes a path from a vertex beyond the first to the next.
void extend(inout Path path, SampleKey key, float time)
{
    Material material = material_to_leave(path);
    LampChoice choice = no_lamp_choice();
    LampLight lamp = no_lamp_light();
    if (SAMPLE_LAMPS) {
        choice = lamp_choice(path.vertex, time);
        lamp = light_of_chosen_lamp(path, material, choice, time, chosen_lamp_numbers(key, path.vertex_count), 1.0);
    }
    leave(path, material, lamp, choice, false, time, direction_numbers(key, path.vertex_count), 1.0);
}

// Light that the first vertex and all paths from it bring. What it sends to the camera is most of the picture, so it
// samples every lamp if they are few, and is left in several branches where paths go further than one direction.
vec3 light_from_first_vertex(Vertex vertex, SampleKey key, float time)
{
    const float directions = float(BRANCH_COUNT);
    Path first = Path(vertex, vec3(1.0), vec3(0.0), 1u, true);
    Material material = material_to_leave(first);
    LampChoice choice = no_lamp_choice();
    if (SAMPLE_ONE_LAMP)
        choice = lamp_choice(vertex, time);

    // Lamp b shares its walk over the scene with branch b's ray; lamps beyond the last branch have one of their own.
    vec3 radiance = vec3(0.0);
    if (SAMPLE_EVERY_LAMP && LAMP_COUNT > BRANCH_COUNT) {
        Start start = Start(vertex.position, vertex.surface, vertex.inside);
        uint i = BRANCH_COUNT;
        [[unroll]] do {
            LampView view = view_lamp(vertex, i, time);
            LampLight lamp = light_of_lamp(first, material, view, i, every_lamp_numbers(key, i), 1.0, directions);
            radiance += is_blocked(start, time, lamp.shadow) ? vec3(0.0) : lamp.light;
            ++i;
        } while (i < LAMP_COUNT);
    }

    uint branch = 0u;
    do {
        SampleKey branch_numbers = branch_key(key, branch);
        LampLight lamp = no_lamp_light();
        if (SAMPLE_EVERY_LAMP && branch < LAMP_COUNT) {
            LampView view = view_lamp(vertex, branch, time);
            lamp = light_of_lamp(first, material, view, branch, every_lamp_numbers(key, branch), 1.0, directions);
        }
        if (SAMPLE_ONE_LAMP) {
            vec3 numbers = chosen_lamp_numbers(branch_numbers, 1u);
            lamp = light_of_chosen_lamp(first, material, choice, time, numbers, directions);
        }

        // The number that chooses the lobe is stratified over the branches; the sum may round up to 1.
        vec4 numbers = direction_numbers(branch_numbers, 1u);
        numbers.z = min((numbers.z + float(branch)) / directions, LARGEST_NUMBER);
        Path path = first;
        leave(path, material, lamp, choice, SAMPLE_EVERY_LAMP, time, numbers, directions);
        if (MAX_PATH_LENGTH > 2u && path.alive) {
            do {
                extend(path, branch_numbers, time);
            } while (path.alive && path.vertex_count < MAX_PATH_LENGTH);
        }
        radiance += path.radiance;
        ++branch;
    } while (branch < BRANCH_COUNT);
    return radiance;
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
    if (hit.surface == NO_SURFACE)
        return vec3(0.0);
    vec3 radiance = emission_of(hit.surface).rgb;
    if (MAX_PATH_LENGTH > 1u)
        radiance +=
            light_from_first_vertex(vertex_at(vec3(0.0), direction, hit.distance, hit.surface, time), key, time);
    return radiance;
}

#endif
