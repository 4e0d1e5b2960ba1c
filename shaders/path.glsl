#ifndef PATH_GLSL
#define PATH_GLSL

#include "camera.glsl"
#include "dimensions.glsl"
#include "intersect.glsl"
#include "lights.glsl"
#include "phong.glsl"
#include "sampling.glsl"
#include "spots.glsl"
#include "step.glsl"
#include "trace.glsl"
#include "vertex.glsl"

// Light that arrives from a second vertex in the direction of a spot. The light is weighted against the branches, which
// also find it (Veach 1997, chapter 9). Only the branches find light of longer paths before the spot.
vec3 light_by_way_of_spot(Vertex vertex, Material material, Spots spots, SampleKey key, float time)
{
    vec3 numbers = spot_numbers(key);
    uint spot = choose_spot(spots, numbers.z);
    vec3 direction = direction_to_spot(spots, spot, vertex.position, time, numbers.xy);
    Reflection towards = reflection(material, vertex, direction);
    Start start = Start(vertex.position, vertex.surface, vertex.inside);
    bool blocked;
    Hit hit = ahead(closest_hit_and_shadow(start, time, direction, NO_SHADOW_RAY, blocked));

    Path path = path_from(Arrival(vertex.position + hit.distance * direction, direction, spot_surface(spot)));
    float density = spot_density(spots, path.arrival, hit.distance, time);
    bool met = hit.surface == path.arrival.surface && density > 0.0;
    float weight = power_heuristic_over_density(density, towards.density * float(BRANCH_COUNT));
    path.throughput = towards.f * (met ? towards.cosine * weight : 0.0);
    path.vertex_count = 2u;
    trace_vertex(2u, path.arrival.point, path.throughput);
    departure_share = 1.0;
    extend(path, key, blocks_at_spot(), MAX_PATH_LENGTH - 1u, time);
    return met ? path.radiance : vec3(0.0); // may be NaN after a miss
}

// Weight of the light that a branch finds at its second vertex, because light_by_way_of_spot() may find it too.
float share_beside_spots(Spots spots, Path path, Vertex first, float time)
{
    float distance = dot(path.arrival.point - first.position, path.arrival.direction);
    float density = spot_density(spots, path.arrival, distance, time);
    return density > 0.0 ? power_heuristic(arrival_density, density) : 1.0;
}

// Light reflected at the first vertex. This is most of the picture's light, so several branches leave the vertex.
vec3 light_from_first_vertex(Arrival arrival, SampleKey key, float time)
{
    const float directions = float(BRANCH_COUNT);
    const vec3 whole = vec3(1.0);
    Vertex vertex = vertex_at(arrival, time);
    Material material = material_to_leave(vertex.surface, 1u);
    Lamps lamps;
    if (SAMPLE_LAMPS)
        lamps = lamps_from(vertex, time);

    // The shadow ray to lamp b is traced in one walk with branch b. Lamps beyond the last branch have walks of their
    // own.
    vec3 radiance = vec3(0.0);
    if (SAMPLE_EVERY_LAMP && LAMP_COUNT > BRANCH_COUNT) {
        Start start = Start(vertex.position, vertex.surface, vertex.inside);
        uint opacity = opacity_number(branch_key(key, BRANCH_COUNT - 1u), 1u);
        uint i = BRANCH_COUNT;
        [[unroll]] do {
            vec2 place = every_lamp_numbers(key, i);
            LampLight lamp = light_of_lamp(whole, vertex, material, choice_of(lamps, i), place, 1.0, directions);
            radiance += lamp.light * (is_hidden(lamp.shadow, start, time, opacity) ? 0.0 : lamp.weight);
            ++i;
        } while (i < LAMP_COUNT);
    }

    Spots spots;
    if (SPOT_COUNT > 0u) {
        spots = spots_from(vertex, time);
        radiance += light_by_way_of_spot(vertex, material, spots, key, time);
    }

    uint branch = 0u;
    do {
        SampleKey branch_numbers = branch_key(key, branch);
        LampLight lamp = NO_LAMP_LIGHT;
        if (SAMPLE_EVERY_LAMP && branch < LAMP_COUNT) {
            vec2 place = every_lamp_numbers(key, branch);
            lamp = light_of_lamp(whole, vertex, material, choice_of(lamps, branch), place, 1.0, directions);
        }
        if (SAMPLE_LAMPS && !SAMPLE_EVERY_LAMP) {
            ChosenLampNumbers chosen = chosen_lamp_numbers(branch_numbers, first_vertex_blocks());
            lamp = light_of_chosen_lamp(whole, vertex, material, lamps, chosen, directions, directions);
        }

        vec4 numbers = direction_numbers(branch_numbers, first_vertex_blocks(), vertex_blocks(1u, LAMP_COUNT));
        numbers.z = lobe_number(numbers.z, branch, directions);
        Path path = path_from(arrival);
        if (SPOT_COUNT > 0u)
            departure_share = 1.0;
        uint opacity = opacity_number(branch_numbers, 1u);
        leave(path, vertex, material, lamp, lamps, SAMPLE_EVERY_LAMP ? 0.0 : directions, time, numbers, opacity,
              directions);
        if (SPOT_COUNT > 0u)
            departure_share = share_beside_spots(spots, path, vertex, time);
        if (MAX_PATH_LENGTH > 2u && path.alive) {
            do {
                extend(path, branch_numbers, later_vertex_blocks(path.vertex_count), path.vertex_count, time);
            } while (path.alive && path.vertex_count < MAX_PATH_LENGTH);
        }
        radiance += path.radiance;
        ++branch;
    } while (branch < BRANCH_COUNT);
    return radiance;
}

#include "camera_walk.glsl"

CameraRay camera_ray(CameraView camera, uvec2 pixel, SampleKey key)
{
    if (LENS == 1)
        return ray_through_lens(camera, pixel, camera_numbers(key), concentric_disc(sample_block(key, 1u).xy));
    return ray_through(camera, pixel, camera_numbers(key));
}

uint covered_samples = 0u; // with COVERAGE: samples whose camera rays have hit a surface

vec3 emitted_by(uint surface) { return may_emit(surface) ? emission_of(surface).rgb : vec3(0.0); }

vec3 path_radiance(CameraView camera, uvec2 pixel, SampleKey key)
{
    CameraRay ray = camera_ray(camera, pixel, key);
    Walk walk = walk_from_camera(ray, opacity_number(key, 0u));
    finish(walk, false);
    Hit hit = walk.hit;
    if (hit.surface == NO_SURFACE)
        return vec3(0.0);
    if (COVERAGE == 1u)
        ++covered_samples;
    vec3 radiance = emitted_by(hit.surface);
    if (MAX_PATH_LENGTH > 1u)
        radiance += light_from_first_vertex(arrival_of(ray, hit), key, ray.time);
    return radiance;
}

#endif
