// Paths among tree spheres, in short steps. Invocations of a subgroup would wait for the longest walk. So all walks
// take a few iterations of the loop, and finished walks then continue with the next ray, branch or sample (Aila and
// Laine, "Understanding the Efficiency of Ray Traversal on GPUs", HPG 2009, section 3.3). path.glsl gives the same
// results.
#ifndef TREE_PATH_GLSL
#define TREE_PATH_GLSL

#include "path.glsl"

struct TreeSample {
    SampleKey key;
    CameraRay camera;
    bool has_met;  // the walk of the camera ray is done
    Arrival first; // hit of the camera ray
    vec3 radiance; // sum over finished paths
    uint branch;
    Path path;
};

// Departures that belong to no branch come first. They have only a shadow ray to their lamp.
const uint FIRST_DEPARTURES = SAMPLE_EVERY_LAMP && LAMP_COUNT > BRANCH_COUNT ? LAMP_COUNT : BRANCH_COUNT;
const uint FIRST_BRANCH = FIRST_DEPARTURES > BRANCH_COUNT ? BRANCH_COUNT : 0u;

TreeSample sample_of(SampleKey key, CameraRay ray)
{
    const Arrival nowhere = Arrival(vec3(0.0), vec3(0.0), NO_SURFACE);
    return TreeSample(key, ray, false, nowhere, vec3(0.0), FIRST_BRANCH, path_from(nowhere));
}

Walk leave_last_vertex(inout TreeSample current, out Departure departure, out Lamps lamps)
{
    float time = current.camera.time;
    bool at_first = current.path.vertex_count == 1u;
    bool every_lamp = SAMPLE_EVERY_LAMP && at_first;
    float directions = at_first ? float(BRANCH_COUNT) : 1.0;
    float lamp_choices = every_lamp ? 0.0 : directions;
    SampleKey key = branch_key(current.key, min(current.branch, BRANCH_COUNT - 1u));
    uint begin = at_first ? first_vertex_blocks() : later_vertex_blocks(current.path.vertex_count);
    Vertex vertex = vertex_at(current.path.arrival, time);
    Material material = material_to_leave(vertex.surface, current.path.vertex_count);

    LampLight lamp = NO_LAMP_LIGHT;
    if (SAMPLE_LAMPS) {
        lamps = lamps_from(vertex, time);
        LampChoice choice;
        vec2 place;
        if (every_lamp) {
            uint own = min(current.branch, LAMP_COUNT - 1u);
            choice = choice_of(lamps, own);
            place = every_lamp_numbers(current.key, own);
        } else {
            ChosenLampNumbers chosen = chosen_lamp_numbers(key, begin);
            choice = choose(lamps, chosen.which);
            place = chosen.place;
        }
        float samples = lamp_samples(choice, lamp_choices);
        if (!every_lamp || current.branch < LAMP_COUNT)
            lamp = light_of_lamp(current.path.throughput, vertex, material, choice, place, samples, directions);
    }

    vec4 numbers = direction_numbers(key, begin, vertex_blocks(at_first ? 1u : 2u, LAMP_COUNT));
    if (at_first)
        numbers.z = lobe_number(numbers.z, current.branch, directions);
    departure = depart(current.path, vertex, material, lamp, lamp_choices, numbers, directions);
    departure.carries_light = departure.carries_light && current.branch < BRANCH_COUNT;
    return walk_onwards(vertex, current.path, departure, time, opacity_number(key, current.path.vertex_count));
}

bool ends_with(inout TreeSample current, Walk walk, Departure departure, Lamps lamps)
{
    if (!current.has_met) {
        current.has_met = true;
        if (walk.hit.surface == NO_SURFACE)
            return true;
        if (COVERAGE == 1u)
            ++covered_samples;
        current.first = arrival_of(current.camera, walk.hit);
        current.path = path_from(current.first);
        return MAX_PATH_LENGTH == 1u;
    }

    arrive(current.path, departure, lamps, ahead(walk.hit), walk.blocked);
    if (current.path.alive && current.path.vertex_count < MAX_PATH_LENGTH)
        return false;
    current.radiance += current.path.radiance;
    current.path = path_from(current.first);
    current.branch = current.branch + 1u == FIRST_DEPARTURES ? 0u : current.branch + 1u;
    return current.branch == FIRST_BRANCH;
}

vec3 value_of(TreeSample ended)
{
    return ended.first.surface == NO_SURFACE ? vec3(0.0) : emitted_by(ended.first.surface) + ended.radiance;
}

#endif
