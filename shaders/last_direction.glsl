// One last direction for all branches of a sample (ONE_LAST_DIRECTION). At its last vertex each branch samples a lamp,
// and what a direction finds beyond that is little where paths are long; so one branch alone goes on, chosen by what it
// may find, in place of all.
#ifndef LAST_DIRECTION_GLSL
#define LAST_DIRECTION_GLSL

#include "step.glsl"

// The vertex at which branches end.
const uint BRANCH_END = MAX_PATH_LENGTH - ONE_LAST_DIRECTION;

// Directions that each branch takes there, on average.
float last_directions() { return 1.0 / float(BRANCH_COUNT); }

// Of branches that end one after the other, one is kept, with a probability proportional to its worth: the new one
// replaces that which was kept with the probability of its share in the worth so far (Chao 1982).
struct Reservoir {
    Arrival arrival;
    vec3 throughput;
    float worth;
    float total_worth; // of all branches so far
    float number;      // uniform in [0, 1), whatever has been chosen
};

Reservoir empty_reservoir(Arrival any, float number)
{
    return Reservoir(any, vec3(0.0), 1.0, 0.0, number);
}

// One number decides all choices: where it is below the share it is uniform there, and else in what is above.
void offer(inout Reservoir reservoir, Path path, float worth)
{
    reservoir.total_worth += worth;
    float share = worth > 0.0 ? worth / reservoir.total_worth : 0.0;
    bool kept = reservoir.number < share;
    float rest = kept ? reservoir.number / share : (reservoir.number - share) / (1.0 - share);
    reservoir.number = at_most(rest, LARGEST_NUMBER);
    if (kept) {
        reservoir.arrival = path.arrival;
        reservoir.throughput = path.throughput;
        reservoir.worth = worth;
    }
}

// What a direction may find is the more the more its surface mirrors: lamps are found by sampling them where it does
// not. (The tenth is by trial.)
float worth_of(Path path, Material material)
{
    return strongest_of(path.throughput) * (material.specular_probability + 0.1);
}

// Light of a lamp that reaches the last vertex of a branch, which then may be kept to go on from there.
void end_branch(inout Path path, SampleKey key, float time, inout Reservoir reservoir)
{
    Vertex vertex = vertex_at(path.arrival, time);
    Material material = material_of(vertex.surface);
    Lamps lamps = lamps_from(vertex, time);
    ChosenLampNumbers numbers = chosen_lamp_numbers(key, later_vertex_blocks(BRANCH_END));
    LampLight lamp = light_of_chosen_lamp(path.throughput, vertex, at_last_direction(material), lamps, numbers, 1.0,
                                          last_directions());
    bool blocked = is_hidden(lamp.shadow, Start(vertex.position, vertex.surface, vertex.inside), time);
    path.radiance += lamp.light * (blocked ? 0.0 : lamp.weight);
    offer(reservoir, path, worth_of(path, material));
}

// Light that the branch which was kept finds in its direction, for all of them: its throughput times the mean of their
// worths over its own.
vec3 light_in_last_direction(Reservoir reservoir, vec4 numbers, float time)
{
    Vertex vertex = vertex_at(reservoir.arrival, time);
    Material material = at_last_direction(material_of(vertex.surface));
    Lamps lamps = lamps_from(vertex, time);
    Path path = path_from(reservoir.arrival);
    path.throughput = reservoir.throughput * (reservoir.total_worth * last_directions() / reservoir.worth);
    path.vertex_count = BRANCH_END;
    leave(path, vertex, material, no_lamp_light(), lamps, 1.0, time, numbers, last_directions());
    return path.radiance;
}

#endif
