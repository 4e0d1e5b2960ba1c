// Hooks that pass the path of a sample to `pt view`. Without TRACE_PIXEL they do nothing. `pt view` compiles the kernel
// with the index of a pixel as TRACE_PIXEL. All invocations then take the same sample of this pixel, and each stores
// half a record as its own pixel of the film.
#ifndef TRACE_GLSL
#define TRACE_GLSL

#ifdef TRACE_PIXEL

#include "gpu_layout.h"

const uint TRACED_HEADER = 1u; // number of records, distance from the camera to the origin of positions
const uint TRACED_NUMBER = 2u;
const uint TRACED_WORDS = 3u; // random numbers in units of 2^-32, and their count
const uint TRACED_VERTEX = 4u;
const uint TRACED_THROUGHPUT = 5u;
const uint TRACED_RADIANCE = 6u; // in film units

uint trace_piece;
uint trace_count = 1u;
uvec4 trace_kept = uvec4(0u);
float trace_origin;

void trace_record(uint kind, uvec3 words)
{
    if (trace_count == trace_piece / 2u)
        trace_kept = uvec4(words, kind);
    ++trace_count;
}

// number counts the path's vertices from 1. throughput does not include the reflection at this vertex.
void trace_vertex(uint number, vec3 position, vec3 throughput)
{
    trace_record(TRACED_VERTEX, floatBitsToUint(position));
    trace_record(TRACED_THROUGHPUT | number << 3u, floatBitsToUint(throughput));
}

float traced_number(float number)
{
    trace_record(TRACED_NUMBER, uvec3(floatBitsToUint(number), 0u, 0u));
    return number;
}

uvec4 traced_words(uvec4 words)
{
    trace_record(TRACED_WORDS | 3u << 3u, words.xyz);
    trace_record(TRACED_WORDS | 1u << 3u, uvec3(words.w, 0u, 0u));
    return words;
}

uint traced_pixel(uint index, CameraView camera)
{
    trace_piece = index;
    trace_origin = camera.start_scale * length(camera.forward);
    return TRACE_PIXEL;
}

// Returns the value that the film gets in place of the sample's. A record takes two pixels, because a float has 24
// exact bits.
vec3 traced_sample(vec3 value)
{
    trace_record(TRACED_RADIANCE, floatBitsToUint(value));
    if (trace_piece < 2u)
        trace_kept = uvec4(1u << 31, trace_count, floatBitsToUint(trace_origin), TRACED_HEADER);
    bool is_first = (trace_piece & 1u) == 0u;
    return is_first ? vec3(trace_kept.xyz >> 8u) : vec3((trace_kept.xyz & 255u) | uvec3(trace_kept.w << 8u, 0u, 0u));
}

#else

#define trace_vertex(number, position, throughput)
#define traced_number(number) number
#define traced_words(words) words
#define traced_pixel(index, camera) index
#define traced_sample(value) value

#endif

#endif
