// The path tracer's kernel: each invocation takes samples of a slice in one pixel; SHARERS of them, along y, share
// those of a pixel. Without a number of sharers (0) a workgroup has the pixels of a tile that a list names, and the
// dispatch says how many share them.
#version 450
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_control_flow_attributes : require

#include "gpu_layout.h"

layout(local_size_x = WORKGROUP_SIZE) in;
layout(push_constant) uniform Push { FrameConstants frame; };

#include "film.glsl"
#include "path.glsl"
#include "tile_list.glsl"
#include "tree_path.glsl"

// One sample per pixel of a pass that is split over several submissions: kept aside until all its pixels are there,
// so that the film always holds whole samples. The last component counts the sample.
layout(set = 0, binding = BINDING_PASS) buffer Pass { vec4 samples[]; } split_pass;

// The push constants are read once, into held, and not by each sample: lavapipe 22.3 reads them for one invocation
// after the other, which took an eighth of the time of paths of two vertices.

// The key of a sample of the pixel by its number in the slice.
SampleKey key_of_sample(SampleKey pixel, FrameConstants held, uint number)
{
    const uint row_length = row_blocks(TABLE_BLOCKS, blocks_of_sample(), BRANCH_COUNT);
    SampleKey key = pixel;
    key.sample_index = held.first_sample + number;
    key.row = number * row_length;
    return key;
}

// Adds a sample, and returns its value.
vec3 add_sample(FrameConstants held, inout FilmPixel gathered, vec3 radiance)
{
    vec3 value = radiance * held.film_scale;
    film_add(gathered, value);
    return value;
}

// Takes the samples from done to end, and returns the last one's value.
vec3 take_samples(uvec2 pixel, uint pixel_index, inout uint done, uint end, inout FilmPixel gathered)
{
    FrameConstants held = frame;
    SampleKey key = key_of_pixel(held.seed, pixel_index);
    keep_shifts(key);
    vec3 value = vec3(0.0);
    do {
        vec3 radiance = path_radiance(held, pixel, key_of_sample(key, held, done));
        if (TREE == 0u || !walk_was_cut)
            value = add_sample(held, gathered, radiance);
        ++done;
    } while (done < end);
    return value;
}

// The same step by step (tree_path.glsl).
vec3 take_samples_by_steps(uvec2 pixel, uint pixel_index, inout uint done, uint end, inout FilmPixel gathered)
{
    FrameConstants held = frame;
    SampleKey pixel_key = key_of_pixel(held.seed, pixel_index);
    vec3 value = vec3(0.0);
    TreeSample current;
    Departure departure;
    Lamps lamps;
    Walk walk;
    walk.done = true;
    bool begins = true;
    do {
        if (walk.done) {
            // What the walk has found.
            if (!begins) {
                begins = ends_with(current, walk, departure, lamps);
                if (begins) {
                    value = add_sample(held, gathered, value_of(current));
                    ++done;
                }
            }

            // The next one, of this sample or the next.
            if (!begins) {
                walk = leave_last_vertex(current, departure, lamps);
            } else if (done < end) {
                SampleKey key = key_of_sample(pixel_key, held, done);
                current = sample_of(key, camera_ray(held, pixel, key));
                walk = walk_from_camera(current.camera);
                begins = false;
            }
        }
        go_on(walk, WALK_TRIPS, true);
    } while (done < end);
    return value;
}

void main()
{
    uint pixel_in_strip;
    if (!has_pixel(SHARERS == 0u, pixel_in_strip))
        return;
    uint pixel_index = frame.strip_first_pixel + pixel_in_strip;
    uvec2 pixel = uvec2(pixel_index % frame.width, pixel_index / frame.width);

    // Its samples of the slice: a range of its own.
    uint sharers = SHARERS == 0u ? gl_NumWorkGroups.y : SHARERS;
    uint done = gl_GlobalInvocationID.y * frame.sample_count / sharers;
    uint end = (gl_GlobalInvocationID.y + 1u) * frame.sample_count / sharers;
    if (SHARERS != 1u && done == end)
        return;

    FilmPixel gathered = empty_film_pixel();
    vec3 value;
    if (WALK_TRIPS > 0u)
        value = take_samples_by_steps(pixel, pixel_index, done, end, gathered);
    else
        value = take_samples(pixel, pixel_index, done, end, gathered);

    if (frame.split_pass == 1u)
        split_pass.samples[pixel_in_strip] = vec4(value, TREE == 1u && (walk_was_cut || done < end) ? 0.0 : 1.0);
    else
        film_store(frame.film_part, pixel_in_strip, frame.strip_pixel_count, gathered, OVERLAP == 1u,
                   frame.is_first == 1u);
}
