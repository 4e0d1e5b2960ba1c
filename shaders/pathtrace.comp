// The path tracer's kernel: each invocation takes samples of a slice in one pixel;
// SHARERS of them, along y, share those of a pixel.
#version 450
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_control_flow_attributes : require

#include "gpu_layout.h"

layout(local_size_x = WORKGROUP_SIZE) in;
layout(push_constant) uniform Push { FrameConstants frame; };

#include "film.glsl"
#include "path.glsl"

// One sample per pixel of a pass that is split over several submissions: kept aside until all its pixels are there,
// so that the film always holds whole samples. The last component counts the sample.
layout(set = 0, binding = BINDING_PASS) buffer Pass { vec4 samples[]; } split_pass;

void main()
{
    if (gl_GlobalInvocationID.x >= frame.pixel_count)
        return;
    const uint row_length = row_blocks(TABLE_BLOCKS, shared_blocks(LAMP_COUNT), BRANCH_COUNT);
    uint pixel_in_strip = frame.first_pixel + gl_GlobalInvocationID.x;
    uint pixel_index = frame.strip_first_pixel + pixel_in_strip;
    uvec2 pixel = uvec2(pixel_index % frame.width, pixel_index / frame.width);

    // Its samples of the slice: a range of its own.
    uint done = gl_GlobalInvocationID.y * frame.sample_count / SHARERS;
    uint end = (gl_GlobalInvocationID.y + 1u) * frame.sample_count / SHARERS;
    if (SHARERS > 1u && done == end)
        return;

    FilmPixel gathered = empty_film_pixel();
    vec3 value;
    do {
        SampleKey key = SampleKey(frame.seed, pixel_index, frame.first_sample + done, done * row_length);
        value = path_radiance(frame, pixel, key) * frame.film_scale;
        if (TREE == 0u || !walk_was_cut)
            film_add(gathered, value);
        ++done;
    } while (done < end);

    if (frame.split_pass == 1u)
        split_pass.samples[pixel_in_strip] = vec4(value, TREE == 1u && walk_was_cut ? 0.0 : 1.0);
    else
        film_store(frame.film_part, pixel_in_strip, frame.strip_pixel_count, gathered, OVERLAP == 1u);
}
