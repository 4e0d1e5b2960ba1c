// Adds the film's other part to the part frame.film_part, and clears the other part.
#version 450
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_control_flow_attributes : require

#include "gpu_layout.h"

layout(local_size_x = WORKGROUP_SIZE) in;
layout(push_constant) uniform Push { FrameConstants frame; };

#include "film.glsl"
#include "tile_pixel.glsl"

void main()
{
    TilePixel at = tile_pixel();
    if (!at.exists)
        return;
    uint stride = frame.strip_pixel_count;
    uint kept = frame.film_part * FILM_WORDS * stride + at.in_strip;
    uint emptied = (1u - frame.film_part) * FILM_WORDS * stride + at.in_strip;
    uvec4 moved;
    uvec4 rare;
    [[unroll]] for (uint channel = 0u; channel < 3u; ++channel) {
        uint first = channel * FILM_SUM_WORDS * stride;
        uvec4 sum;
        [[unroll]] for (uint i = 0u; i < FILM_SUM_WORDS; ++i)
            sum[i] = film.words[emptied + first + i * stride];
        moved[channel] = sum.w;
        rare[channel] = film_store_sum(kept + first, stride, sum, false);
    }
    moved.w = film.words[emptied + FILM_REJECTED * stride];
    rare.w = moved.w;
    film_add_rare_words(kept, stride, rare);
    film.words[kept + FILM_ACCEPTED * stride] += film.words[emptied + FILM_ACCEPTED * stride];

    // If the next dispatch overwrites the other part, only its rare words must be 0.
    if (frame.is_first == 0u) {
        [[unroll]] for (uint plane = 0u; plane < FILM_WORDS; ++plane)
            film.words[emptied + plane * stride] = 0u;
    } else {
        [[unroll]] for (uint i = 0u; i < 4u; ++i)
            if (moved[i] != 0u)
                film.words[emptied + rare_plane(i) * stride] = 0u;
    }
}
