// Adds the finished samples of a split pass to the film: one invocation per pixel of the strip.
#version 450
#extension GL_GOOGLE_include_directive : require

#include "gpu_layout.h"

layout(local_size_x = WORKGROUP_SIZE) in;
layout(push_constant) uniform Push { FrameConstants frame; };

#include "film.glsl"

layout(set = 0, binding = BINDING_PASS) buffer Pass { vec4 samples[]; } split_pass;

void main()
{
    if (gl_GlobalInvocationID.x >= frame.pixel_count)
        return;
    uint pixel_in_strip = frame.first_pixel + gl_GlobalInvocationID.x;
    vec4 sample_value = split_pass.samples[pixel_in_strip];
    split_pass.samples[pixel_in_strip] = vec4(0.0);
    FilmPixel gathered = empty_film_pixel();
    if (sample_value.a == 1.0)
        film_add(gathered, sample_value.rgb);
    film_store(frame.film_part, pixel_in_strip, frame.strip_pixel_count, gathered, false, false);
}
