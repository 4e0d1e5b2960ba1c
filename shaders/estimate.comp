// Sums up what the pixels of a film say about the error of its image: one workgroup per region, one invocation per row of
// a tile. A region depends on nothing outside it, and every sum has its order, so that a film always gives the same bits.
#version 450
#extension GL_GOOGLE_include_directive : require

#include "gpu_layout.h"

layout(local_size_x = ESTIMATE_WORKGROUP_SIZE) in;
layout(push_constant) uniform Push { EstimateConstants estimate; };

#include "film_mean.glsl"
#include "pixel_error.glsl"

layout(set = 0, binding = BINDING_RESOLVED) writeonly buffer Tiles { TileError tiles[]; } estimated;

const uint TILES_IN_ROW = REGION_SIZE / TILE_SIZE;
const uint TILES_IN_REGION = TILES_IN_ROW * TILES_IN_ROW;

// Of one channel: the means of the region's pixels, and the sets of them in the rows of tiles, in tiles and in all.
shared float means[REGION_SIZE * REGION_SIZE];
shared ValueSet row_sets[ESTIMATE_WORKGROUP_SIZE];
shared ValueSet tile_sets[TILES_IN_REGION];
// Of all channels: what the rows of tiles add up to.
shared TileError row_errors[ESTIMATE_WORKGROUP_SIZE];

// A number of up to 160 bits that counts 2^-60ths.
float as_float(uint words[NUMBER_WORDS])
{
    return float(words[0]) * exp2(-60.0) + float(words[1]) * exp2(-28.0) + float(words[2]) * exp2(4.0)
         + float(words[3]) * exp2(36.0) + float(words[4]) * exp2(68.0);
}

float as_float(uvec4 sum)
{
    return as_float(uint[NUMBER_WORDS](sum.x, sum.y, sum.z, sum.w, 0u));
}

// What the samples of a pixel show in one channel.
struct Shown {
    float mean;
    float standard_error;
    float lesser; // of the means of the parts
};

// The counts of accepted samples, and what the difference of the sums, each times the other's count, is to be multiplied
// with to be the standard error (film_mean.glsl).
struct Counts {
    uint a;
    uint b;
    float scale;
};

Counts counts_of(PartCount older, PartCount newer)
{
    float a = float(older.accepted);
    float b = float(newer.accepted);
    return Counts(older.accepted, newer.accepted, inversesqrt(a) * inversesqrt(b) / (a + b));
}

Shown shown_in(uint channel, uint pixel_in_strip, Counts counts)
{
    uvec4 sum_a = part_sum(estimate.older_part, channel, pixel_in_strip, estimate.strip_pixel_count);
    uvec4 sum_b = part_sum(1u - estimate.older_part, channel, pixel_in_strip, estimate.strip_pixel_count);
    uint product_a[NUMBER_WORDS] = product(sum_a, counts.b);
    uint product_b[NUMBER_WORDS] = product(sum_b, counts.a);
    uint borrow, unused;
    uint words[NUMBER_WORDS] = difference(product_a, product_b, borrow);
    if (borrow == 1u)
        words = difference(product_b, product_a, unused);
    return Shown(as_float(add_with_carry(sum_a, sum_b)) / float(counts.a + counts.b), as_float(words) * counts.scale,
                 borrow == 1u ? as_float(sum_a) / float(counts.a) : as_float(sum_b) / float(counts.b));
}

// The pixels of the region that touch one, where the region ends beside it: the lower of two in the middle.
Neighbourhood neighbourhood_at_edge(uvec2 place, uvec2 size)
{
    float values[9];
    uint count = 0u;
    uvec2 first = place - min(place, uvec2(1u));
    uvec2 last = min(place + 1u, size - 1u);
    for (uint y = first.y; y <= last.y; ++y)
        for (uint x = first.x; x <= last.x; ++x)
            values[count++] = means[y * REGION_SIZE + x];
    Neighbourhood found = Neighbourhood(0.0, 0.0);
    for (uint i = 0u; i < count; ++i) {
        uint below = 0u;
        for (uint other = 0u; other < count; ++other)
            below += values[other] < values[i] || (values[other] == values[i] && other < i) ? 1u : 0u;
        if (below == (count - 1u) / 2u && count > 1u)
            found.median = values[i];
        found.largest = max(found.largest, values[i]);
    }
    return found;
}

Neighbourhood neighbourhood(uvec2 place, uvec2 size)
{
    if (any(equal(place, uvec2(0u))) || any(equal(place + 1u, size)))
        return neighbourhood_at_edge(place, size);
    uint above = (place.y - 1u) * REGION_SIZE + place.x;
    uint beside = above + REGION_SIZE;
    uint below = beside + REGION_SIZE;
    return neighbourhood_of_rows(sorted(means[above - 1u], means[above], means[above + 1u]),
                                 sorted(means[beside - 1u], means[beside], means[beside + 1u]),
                                 sorted(means[below - 1u], means[below], means[below + 1u]));
}

// Sums of squares with the sum of the squares of their shares in them.
void add_squares(inout float sum, inout float shares, float other_sum, float other_shares)
{
    float all = sum + other_sum;
    shares = all > 0.0 ? (squared(sum / all) * shares + squared(other_sum / all) * other_shares) : 0.0;
    sum = all;
}

void add(inout TileError to, TileError other)
{
    add_squares(to.square, to.square_shares, other.square, other.square_shares);
    add_squares(to.relative_square, to.relative_shares, other.relative_square, other.relative_shares);
    to.unseen += other.unseen;
    uint carry;
    to.rejected.x = uaddCarry(to.rejected.x, other.rejected.x, carry);
    to.rejected.y += other.rejected.y + carry;
    to.unknown_pixels += other.unknown_pixels;
    to.lost_pixels += other.lost_pixels;
}

void main()
{
    const uint tile = gl_LocalInvocationID.x / TILE_SIZE;
    const uvec2 tile_place = uvec2(tile % TILES_IN_ROW, tile / TILES_IN_ROW);
    const uvec2 region_place = gl_WorkGroupID.xy * REGION_SIZE;
    const uvec2 size = min(uvec2(estimate.film_width, estimate.row_count) - region_place, uvec2(REGION_SIZE));
    const uvec2 row_place = tile_place * TILE_SIZE + uvec2(0u, gl_LocalInvocationID.x % TILE_SIZE);
    const uint row_pixels = row_place.y < size.y && row_place.x < size.x ? min(size.x - row_place.x, TILE_SIZE) : 0u;
    const uint first_pixel =
        (region_place.y + row_place.y) * estimate.film_width + region_place.x + row_place.x;

    // What all channels have in common.
    TileError row = TileError(0.0, 0.0, 0.0, 0.0, 0.0, 0u, 0u, 0u, uvec2(0u));
    Counts counts[TILE_SIZE];
    float squares[TILE_SIZE];
    float relative_squares[TILE_SIZE];
    for (uint i = 0u; i < row_pixels; ++i) {
        PartCount older = part_count(estimate.older_part, first_pixel + i, estimate.strip_pixel_count);
        PartCount newer = part_count(1u - estimate.older_part, first_pixel + i, estimate.strip_pixel_count);
        bool is_known = older.accepted > 0u && newer.accepted > 0u;
        row.unknown_pixels += is_known ? 0u : 1u;
        row.lost_pixels += uvec2(older.done, newer.done) != estimate.sample_counts ? 1u : 0u;
        uint carry;
        row.rejected.x = uaddCarry(row.rejected.x, older.done - older.accepted, carry);
        row.rejected.y += carry;
        row.rejected.x = uaddCarry(row.rejected.x, newer.done - newer.accepted, carry);
        row.rejected.y += carry;
        counts[i] = counts_of(older, newer);
        squares[i] = 0.0;
        relative_squares[i] = 0.0;
    }

    for (uint channel = 0u; channel < 3u; ++channel) {
        // The means of the region, and what they are on the average: of rows of tiles, then of tiles, then of all.
        Shown shown[TILE_SIZE];
        ValueSet row_set = empty_set();
        for (uint i = 0u; i < row_pixels; ++i) {
            shown[i] = shown_in(channel, first_pixel + i, counts[i]);
            means[row_place.y * REGION_SIZE + row_place.x + i] = shown[i].mean;
            row_set = with_value(row_set, shown[i].mean);
        }
        row_sets[gl_LocalInvocationID.x] = row_set;
        barrier();
        if (gl_LocalInvocationID.x < TILES_IN_REGION) {
            ValueSet tile_set = empty_set();
            for (uint i = 0u; i < TILE_SIZE; ++i)
                tile_set = united(tile_set, row_sets[gl_LocalInvocationID.x * TILE_SIZE + i]);
            tile_sets[gl_LocalInvocationID.x] = tile_set;
        }
        barrier();
        ValueSet region_set = empty_set();
        for (uint i = 0u; i < TILES_IN_REGION; ++i)
            region_set = united(region_set, tile_sets[i]);

        for (uint i = 0u; i < row_pixels; ++i) {
            Neighbourhood near = neighbourhood(row_place + uvec2(i, 0u), size);
            float around = max(near.median, level_about(shown[i].mean, tile_sets[tile], region_set));
            squares[i] += squared(shown[i].standard_error);
            relative_squares[i] +=
                relative_square(shown[i].standard_error, shown[i].mean, shown[i].lesser, around,
                                RelativeError(estimate.relative_offset, estimate.relative_scale));
            row.unseen +=
                unseen_square(shown[i].mean, near.largest, estimate.sample_count, estimate.relative_offset);
        }
        barrier(); // before the next channel's means
    }

    for (uint i = 0u; i < row_pixels; ++i) {
        add_squares(row.square, row.square_shares, squares[i], 1.0);
        add_squares(row.relative_square, row.relative_shares, relative_squares[i], 1.0);
    }
    row_errors[gl_LocalInvocationID.x] = row;
    barrier();
    if (gl_LocalInvocationID.x < TILES_IN_REGION) {
        TileError sum = row_errors[gl_LocalInvocationID.x * TILE_SIZE];
        for (uint i = 1u; i < TILE_SIZE; ++i)
            add(sum, row_errors[gl_LocalInvocationID.x * TILE_SIZE + i]);
        uint region = gl_WorkGroupID.y * gl_NumWorkGroups.x + gl_WorkGroupID.x;
        estimated.tiles[region * TILES_IN_REGION + gl_LocalInvocationID.x] = sum;
    }
}
