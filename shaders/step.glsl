#ifndef STEP_GLSL
#define STEP_GLSL

#include "dimensions.glsl"
#include "intersect.glsl"
#include "lights.glsl"
#include "phong.glsl"
#include "trace.glsl"
#include "tree_walk.glsl"
#include "vertex.glsl"

// The first vertex samples every lamp if there are few. Otherwise a vertex chooses one lamp.
const bool SAMPLE_LAMPS = PT_SAMPLES_LAMPS && LAMP_COUNT > 0u;
const bool SAMPLE_EVERY_LAMP = SAMPLE_LAMPS && LAMP_COUNT <= EVERY_LAMP_LIMIT;

struct Path {
    Arrival arrival;
    vec3 throughput;
    vec3 radiance;
    uint vertex_count;
    bool alive;
};

// State of the current path, for scenes with spots only.
float arrival_density; // density of the last direction times the number of directions
float departure_share; // weight of lamp light at the next departure, because light_by_way_of_spot() may find it too

Path path_from(Arrival first) { return Path(first, vec3(1.0), vec3(0.0), 1u, true); }

// Weights of lamp samples and directions, by multiple importance sampling. With ESTIMATOR_LIGHT lamp samples have
// weight 1. Densities are multiplied by the vertex's number of samples (Veach 1997, section 9.2.2).
float lamp_weight_over_density(float lamp_density, float direction_density)
{
    return ESTIMATOR == ESTIMATOR_LIGHT ? 1.0 / lamp_density
                                        : power_heuristic_over_density(lamp_density, direction_density);
}

float direction_weight_against(float direction_density, float lamp_density)
{
    if (ESTIMATOR == ESTIMATOR_LIGHT)
        return lamp_density > 0.0 ? 0.0 : 1.0;
    return power_heuristic(direction_density, lamp_density);
}

struct LampLight {
    ShadowRay shadow;
    vec3 light;
    float weight;
};

const LampLight NO_LAMP_LIGHT = LampLight(NO_SHADOW_RAY, vec3(0.0), 0.0);

LampLight light_of_lamp(vec3 throughput, Vertex vertex, Material material, LampChoice choice, vec2 place,
                        float samples, float directions)
{
    LampSample found = sample_lamp(choice, place);
    float density = found.density * samples;
    Reflection towards = reflection(material, vertex, found.shadow.direction);
    float weight = lamp_weight_over_density(density, towards.density * directions);
    vec3 light = throughput * towards.f * emission_of_lamp(choice.lamp).rgb;
    return LampLight(found.shadow, light, density > 0.0 ? towards.cosine * weight : 0.0);
}

// Expected number of samples of the lamp. choices is the number of lamps that the vertex chooses; 0: it samples every
// lamp once.
float lamp_samples(LampChoice choice, float choices)
{
    return choices > 0.0 ? choice.probability * choices : 1.0;
}

LampLight light_of_chosen_lamp(vec3 throughput, Vertex vertex, Material material, Lamps lamps,
                               ChosenLampNumbers numbers, float choices, float directions)
{
    LampChoice choice = choose(lamps, numbers.which);
    float samples = lamp_samples(choice, choices);
    return light_of_lamp(throughput, vertex, material, choice, numbers.place, samples, directions);
}

// Stratifies the number over branches. The quotient may round up to 1.
float lobe_number(float number, uint branch, float directions)
{
    return at_most((number + float(branch)) / directions, LARGEST_NUMBER);
}

struct Departure {
    vec3 origin;
    vec3 direction;
    float density;   // density over solid angle times the number of directions
    float strongest; // largest component of the throughput
    bool carries_light;
    float survival; // random number for Russian roulette
    LampLight lamp;
    float lamp_choices;
};

// The caller chooses the lamp, because a condition here would be slower on GPUs.
Departure depart(inout Path path, Vertex vertex, Material material, LampLight lamp, float lamp_choices, vec4 numbers,
                 float directions)
{
    Departure departure;
    departure.origin = vertex.position;
    departure.direction = sample_direction(material, vertex, numbers.xy, numbers.z);
    Reflection onwards = reflection(material, vertex, departure.direction);
    departure.density = onwards.density * directions;
    path.throughput *= onwards.f * (departure.density > 0.0 ? onwards.cosine / departure.density : 0.0);
    departure.strongest = strongest_of(path.throughput);
    departure.carries_light = !(departure.strongest <= 0.0); // also true for NaN, so that the film rejects it
    departure.survival = numbers.w;
    departure.lamp = lamp;
    departure.lamp_choices = lamp_choices;
    return departure;
}

// Adds the light that a walk found and moves the path to the hit.
void arrive(inout Path path, Departure departure, Lamps lamps, Hit hit, bool blocked)
{
    float lamp_weight = departure.lamp.weight;
    if (SPOT_COUNT > 0u)
        lamp_weight *= departure_share;
    path.radiance += departure.lamp.light * (blocked ? 0.0 : lamp_weight);

    // Emission of lamps is weighted against lamp sampling.
    path.alive = hit.surface != NO_SURFACE && departure.carries_light;
    if (path.alive && may_emit(hit.surface)) {
        float weight = 1.0;
        uint hit_lamp = lamp_of(hit.surface);
        if (SAMPLE_LAMPS && hit_lamp < LAMP_COUNT) {
            LampChoice choice = choice_of(lamps, hit_lamp);
            float samples = lamp_samples(choice, departure.lamp_choices);
            weight = direction_weight_against(departure.density, cone_density(choice.view) * samples);
        }
        if (SPOT_COUNT > 0u)
            weight *= departure_share;
        path.radiance += path.throughput * emission_of(hit.surface).rgb * weight;
    }
    if (SPOT_COUNT > 0u) {
        arrival_density = departure.density;
        departure_share = 1.0;
    }
    path.arrival = Arrival(departure.origin + hit.distance * departure.direction, departure.direction, hit.surface);
    ++path.vertex_count;
    trace_vertex(path.vertex_count, path.arrival.point, path.throughput);

    // Russian roulette from the fourth vertex on, relative to a branch's initial throughput. The minimum 0.05 bounds
    // the weights.
    if (ROULETTE && path.vertex_count >= 4u) {
        float survival = at_most(at_least(departure.strongest * float(BRANCH_COUNT), 0.05), 1.0);
        path.alive = path.alive && departure.survival < survival;
        path.throughput /= survival;
    }
}

// Whether a direction may hit an emitting surface. hit is the closest hit outside the tree. A path's last direction
// adds only emission, so this test may save a walk.
bool may_meet_light(Start start, vec3 direction, Hit hit, float time)
{
    const uint few_lamps = min(UNROLLED, 31u);
    if (TREE_LAMPS == 0u)
        return hit.surface != NO_SURFACE && may_emit(hit.surface);
    if (PLANES_EMIT == 1u || SKY_COUNT > 0u || LAMP_COUNT > few_lamps)
        return true;
    bool met = false;
    FOR_EACH(lamp, 0u, LAMP_COUNT,
             met = met ||
                   distance_to_sphere(start, direction, surface_of_lamp(lamp), ball_of_lamp(lamp, time)) < NO_HIT);
    return met;
}

bool is_hidden(ShadowRay towards_lamp, Start start, float time, uint opacity_number)
{
    ShadowRay shadow = ended_as_met(towards_lamp, start, time);
    if (TREE == 1u)
        shadow = ended_as_met_in_tree(shadow, start, time);
    bool blocked = is_blocked(start, time, shadow);
    Walk walk = walk_from(start, shadow.direction, false, shadow, time, opacity_number, Hit(NO_HIT, NO_SURFACE),
                          blocked);
    finish(walk, true);
    return walk.blocked;
}

Walk walk_onwards(Vertex vertex, Path path, inout Departure departure, float time, uint opacity_number)
{
    Start start = Start(vertex.position, vertex.surface, vertex.inside);
    ShadowRay shadow = ended_as_met(departure.lamp.shadow, start, time);
    if (TREE == 1u) {
        shadow = ended_as_met_in_tree(shadow, start, time);
    }
    bool blocked;
    Hit hit = closest_hit_and_shadow(start, time, departure.direction, shadow, blocked);
    bool is_last = path.vertex_count + 1u == MAX_PATH_LENGTH;
    if (TREE == 1u && is_last)
        departure.carries_light = departure.carries_light && may_meet_light(start, departure.direction, hit, time);
    Walk walk = walk_from(start, departure.direction, departure.carries_light, shadow, time, opacity_number, hit, blocked);
    walk.seeks_light = is_last;
    return walk;
}

void leave(inout Path path, Vertex vertex, Material material, LampLight lamp, Lamps lamps, float lamp_choices,
           float time, vec4 numbers, uint opacity_number, float directions)
{
    Departure departure = depart(path, vertex, material, lamp, lamp_choices, numbers, directions);
    Walk walk = walk_onwards(vertex, path, departure, time, opacity_number);
    finish(walk, SAMPLE_LAMPS);
    arrive(path, departure, lamps, ahead(walk.hit), walk.blocked);
}

// Lamp samples do not find the light of skies and emitting planes. In scenes with these, the last direction is sampled
// like others.
Material material_to_leave(uint surface, uint vertex_count)
{
    Material material = material_of(surface);
    bool last = vertex_count + 1u == MAX_PATH_LENGTH;
    return SAMPLE_LAMPS && SKY_COUNT + PLANES_EMIT == 0u && last ? at_last_direction(material) : material;
}

// Extends the path from a vertex beyond the first. begin is the first block of its random numbers. as_vertex is the
// path length for material_to_leave().
void extend(inout Path path, SampleKey key, uint begin, uint as_vertex, float time)
{
    Vertex vertex = vertex_at(path.arrival, time);
    Material material = material_to_leave(vertex.surface, as_vertex);
    Lamps lamps;
    LampLight lamp = NO_LAMP_LIGHT;
    if (SAMPLE_LAMPS) {
        lamps = lamps_from(vertex, time);
        ChosenLampNumbers chosen = chosen_lamp_numbers(key, begin);
        lamp = light_of_chosen_lamp(path.throughput, vertex, material, lamps, chosen, 1.0, 1.0);
    }
    vec4 numbers = direction_numbers(key, begin, vertex_blocks(2u, LAMP_COUNT));
    leave(path, vertex, material, lamp, lamps, 1.0, time, numbers, opacity_number(key, path.vertex_count), 1.0);
}

#endif
