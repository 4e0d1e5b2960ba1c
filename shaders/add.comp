#version 450
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_control_flow_attributes : require

#include "gpu_layout.h"

layout(local_size_x = WORKGROUP_SIZE) in;
layout(push_constant) uniform Push { AddConstants add; };

#include "film.glsl"

layout(set = 0, binding = BINDING_ADDED) readonly buffer Added { uint words[]; } added;

void main()
{
    if (gl_GlobalInvocationID.x >= add.pixel_count)
        return;
    uint from_stride = add.added_stride;
    uint to_stride = add.strip_pixel_count;
    [[unroll]] for (uint part = 0u; part < FILM_PARTS; ++part) {
        uint from = part * FILM_WORDS * from_stride + add.added_first_pixel + gl_GlobalInvocationID.x;
        uint to = part * FILM_WORDS * to_stride + add.first_pixel + gl_GlobalInvocationID.x;
        uvec4 rare;
        [[unroll]] for (uint channel = 0u; channel < 3u; ++channel) {
            uint first = channel * FILM_SUM_WORDS;
            uvec4 sum;
            [[unroll]] for (uint i = 0u; i < FILM_SUM_WORDS; ++i)
                sum[i] = added.words[from + (first + i) * from_stride];
            rare[channel] = film_store_sum(to + first * to_stride, to_stride, sum, false);
        }
        film.words[to + FILM_ACCEPTED * to_stride] += added.words[from + FILM_ACCEPTED * from_stride];
        rare.w = added.words[from + FILM_REJECTED * from_stride];
        film_add_rare_words(to, to_stride, rare);
    }
    if (add.has_coverage == 1u)
        film.words[FILM_COVERED * to_stride + add.first_pixel + gl_GlobalInvocationID.x] +=
            added.words[FILM_COVERED * from_stride + add.added_first_pixel + gl_GlobalInvocationID.x];
}
