// Hooks through which a kernel tells `pt view` the path of a sample. Without TRACE_PIXEL they are nothing. `pt view`
// compiles the kernel again with the index of a pixel as TRACE_PIXEL. Then all invocations take the same sample of this
// pixel, and each writes a piece of the record into its own pixel of the film.
#ifndef TRACE_GLSL
#define TRACE_GLSL

#ifdef TRACE_PIXEL

#include "gpu_layout.h"

const uint TRACED_HEADER = 1u; // number of records, distance from the camera to the origin of positions
const uint TRACED_NUMBER = 2u;
const uint TRACED_WORDS = 3u; // numbers in units of 2^-32, and how many
const uint TRACED_VERTEX = 4u;
const uint TRACED_THROUGHPUT = 5u;
const uint TRACED_RADIANCE = 6u; // in film units

uint trace_piece; // of this invocation: two for each record
uint trace_count = 1u;
uvec4 trace_kept = uvec4(0u);
float trace_origin;

void trace_record(uint kind, uvec3 words)
{
    if (trace_count == trace_piece / 2u)
        trace_kept = uvec4(words, kind);
    ++trace_count;
}

// number counts the vertices of the path from 1. throughput is what the path has before this vertex reflects.
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

// Returns what the film gets for the sample's value. A float holds 24 bits exactly.
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
