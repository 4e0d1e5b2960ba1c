// The path tracer. Each invocation takes some samples of a pixel. Invocations along y take different samples of the
// same pixel.
#version 450
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_control_flow_attributes : require

#include "gpu_layout.h"

layout(local_size_x = WORKGROUP_SIZE) in;
layout(push_constant) uniform Push { FrameConstants frame; };

#include "film.glsl"
#include "path.glsl"
#include "tile_pixel.glsl"
#include "trace.glsl"
#include "tree_path.glsl"

// `held` is a copy of the push constants, because lavapipe 22.3 reads push constants for one invocation after the
// other.

SampleKey key_of_sample(SampleKey pixel, FrameConstants held, uint number)
{
    const uint row_length = row_blocks(TABLE_BLOCKS, blocks_of_sample(), BRANCH_COUNT);
    SampleKey key = pixel;
    key.sample_index = held.first_sample + number;
    key.row = number * row_length;
    return key;
}

void add_sample(FrameConstants held, inout FilmPixel gathered, vec3 radiance)
{
    film_add(gathered, traced_sample(radiance * held.film_scale));
}

// Takes samples `done` to `end` - 1.
void take_samples(uvec2 pixel, uint pixel_index, uint done, uint end, inout FilmPixel gathered)
{
    FrameConstants held = frame;
    SampleKey key = key_of_pixel(held.seed, pixel_index);
    do {
        vec3 radiance = path_radiance(held.camera, pixel, key_of_sample(key, held, done));
        if (TREE == 0u || !walk_was_cut)
            add_sample(held, gathered, radiance);
        ++done;
    } while (done < end);
}

// Like take_samples(), but in steps of walks (tree_path.glsl).
void take_samples_by_steps(uvec2 pixel, uint pixel_index, uint done, uint end, inout FilmPixel gathered)
{
    FrameConstants held = frame;
    SampleKey pixel_key = key_of_pixel(held.seed, pixel_index);
    TreeSample current;
    Departure departure;
    Lamps lamps;
    Walk walk;
    walk.done = true;
    bool begins = true;
    do {
        if (walk.done) {
            if (!begins) {
                begins = ends_with(current, walk, departure, lamps);
                if (begins) {
                    add_sample(held, gathered, value_of(current));
                    ++done;
                }
            }

            if (!begins) {
                walk = leave_last_vertex(current, departure, lamps);
            } else if (done < end) {
                SampleKey key = key_of_sample(pixel_key, held, done);
                current = sample_of(key, camera_ray(held.camera, pixel, key));
                walk = walk_from_camera(current.camera, opacity_number(key, 0u));
                begins = false;
            }
        }
        go_on(walk, WALK_TRIPS, true);
    } while (done < end);
}

void main()
{
    TilePixel at = tile_pixel();
    if (!at.exists)
        return;
    uvec2 pixel = uvec2(at.in_image % frame.camera.width, at.in_image / frame.camera.width);

    uint done = gl_GlobalInvocationID.y * frame.share;
    uint end = min(done + frame.share, frame.sample_count);

    FilmPixel gathered = empty_film_pixel();
    if (WALK_TRIPS > 0u)
        take_samples_by_steps(pixel, at.in_image, done, end, gathered);
    else
        take_samples(pixel, at.in_image, done, end, gathered);
    film_store(frame.film_part, at.in_strip, frame.strip_pixel_count, gathered, OVERLAP == 1u, frame.is_first == 1u);
    if (COVERAGE == 1u)
        film_store_covered(at.in_strip, frame.strip_pixel_count, covered_samples, OVERLAP == 1u);
}
