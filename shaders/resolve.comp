#version 450
#extension GL_GOOGLE_include_directive : require

#include "gpu_layout.h"

layout(local_size_x = WORKGROUP_SIZE) in;
layout(push_constant) uniform Push { ResolveConstants resolve; };

#include "film_parts.glsl"
#include "quotient.h"
#include "resolved.glsl"

layout(constant_id = 0) const uint FORMAT = FORMAT_RGB32F;

bool knows_error(PartCount older, PartCount newer)
{
    return older.done + newer.done >= FILM_MIN_ERROR_SAMPLES && older.accepted > 0u && newer.accepted > 0u;
}

uint value_of(uint channel, uint pixel_in_strip, PartCount older, PartCount newer)
{
    if (resolve.quantity == QUANTITY_SAMPLE_COUNT)
        return floatBitsToUint(float(older.done + newer.done));
    if (resolve.quantity == QUANTITY_COVERAGE)
        return mean_bits(uvec4(film_covered(pixel_in_strip, resolve.strip_pixel_count), 0u, 0u, 0u),
                         older.done + newer.done, 0);
    uvec4 sum_older = part_sum(0u, channel, pixel_in_strip, resolve.strip_pixel_count);
    uvec4 sum_newer = part_sum(1u, channel, pixel_in_strip, resolve.strip_pixel_count);
    if (resolve.quantity == QUANTITY_RADIANCE)
        return mean_bits(add_with_carry(sum_older, sum_newer), older.accepted + newer.accepted, resolve.exponent);
    if (!knows_error(older, newer))
        return floatBitsToUint(infinity);
    bool unused;
    return standard_error_bits(
        weighted_difference(sum_older, older.accepted, sum_newer, newer.accepted, unused),
        error_divisor(older.accepted, newer.accepted), resolve.exponent);
}

void main()
{
    uint index = gl_GlobalInvocationID.x;
    if (index >= resolve.pixel_count)
        return;
    uint row = index / resolve.width;
    uint column = index % resolve.width;
    uint pixel = resolve.first_pixel + row * resolve.film_width + column;
    uint pixel_in_strip = pixel - resolve.strip_first_pixel;
    if (pixel_in_strip >= resolve.strip_pixel_count)
        return;
    PartCount older = part_count(0u, pixel_in_strip, resolve.strip_pixel_count);
    PartCount newer = part_count(1u, pixel_in_strip, resolve.strip_pixel_count);
    if (resolve.sample_counts.x != ANY_COUNT && uvec2(older.done, newer.done) != resolve.sample_counts)
        atomicAdd(findings.lost_pixels, 1u);
    uvec3 value;
    [[unroll]] for (uint channel = 0u; channel < 3u; ++channel)
        value[channel] = value_of(channel, pixel_in_strip, older, newer);
    uint first_word = resolve.first_word + row * resolve.row_words + column * words_of_pixel(FORMAT);
    write_pixel(first_word, FORMAT, value);
}
