// Sums up what the pixels of a film say about the error of its image: one workgroup per region. A region depends on
// nothing outside it, and every sum has its order, so that a film always gives the same bits.
#version 450
#extension GL_GOOGLE_include_directive : require

#include "gpu_layout.h"

layout(local_size_x = ESTIMATE_WORKGROUP_SIZE) in;
layout(push_constant) uniform Push { EstimateConstants estimate; };

#include "film_mean.glsl"
#include "pixel_error.glsl"

layout(set = 0, binding = BINDING_RESOLVED) writeonly buffer Regions { RegionError regions[]; } estimated;

// Of a film whose tiles have different numbers of samples: those in the older and in the newer part of each tile, and what
// its samples alone say of the sum of its values' relative errors squared, and of that of light that none of them met.
layout(constant_id = 0) const uint UNEVEN = 0u;
layout(set = 0, binding = BINDING_TILE_COUNTS) readonly buffer TileCounts { uvec2 counts[]; } tile_samples;
layout(set = 0, binding = BINDING_TILE_SQUARES) writeonly buffer TileSquares { vec2 squares[]; } tile_errors;

const uint TILES_IN_ROW = REGION_SIZE / TILE_SIZE;
const uint TILES_IN_REGION = TILES_IN_ROW * TILES_IN_ROW;
const uint PIXELS_IN_REGION = REGION_SIZE * REGION_SIZE;
const uint PIXELS_OF_INVOCATION = PIXELS_IN_REGION / ESTIMATE_WORKGROUP_SIZE;

// By pixels of the region. Invocations look at pixels one below the other, so that those beside each other read memory
// together; what the pixels add up to is summed by invocations that each have a row of a tile, and then by tiles.
shared float means[PIXELS_IN_REGION];            // of one channel; at last what is unseen in all
shared float squares[PIXELS_IN_REGION];          // of all channels
shared float relative_squares[PIXELS_IN_REGION]; // likewise
shared vec4 rows[ESTIMATE_WORKGROUP_SIZE];
shared ValueSet tile_sets[TILES_IN_REGION];
shared uint tile_counts[TILES_IN_REGION][4]; // rejected samples, low and high; pixels that are unknown, and lost

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
    bool first_is_less;
    uint words[NUMBER_WORDS] = weighted_difference(sum_a, counts.a, sum_b, counts.b, first_is_less);
    return Shown(as_float(add_with_carry(sum_a, sum_b)) / float(counts.a + counts.b), as_float(words) * counts.scale,
                 first_is_less ? as_float(sum_a) / float(counts.a) : as_float(sum_b) / float(counts.b));
}

// A tile's place in the film.
uint film_tile(uvec2 place_in_strip)
{
    uint columns = (estimate.film_width + TILE_SIZE - 1u) / TILE_SIZE;
    return estimate.first_tile + place_in_strip.y / TILE_SIZE * columns + place_in_strip.x / TILE_SIZE;
}

// That a pixel must have.
uvec2 expected_counts(uvec2 place_in_strip)
{
    return UNEVEN == 1u ? tile_samples.counts[film_tile(place_in_strip)] : estimate.sample_counts;
}

void count_in_tile(uint tile, PartCount older, PartCount newer, uvec2 expected)
{
    uint rejected[2] = uint[2](older.done - older.accepted, newer.done - newer.accepted);
    for (uint part = 0u; part < 2u; ++part)
        if (rejected[part] != 0u) {
            uint before = atomicAdd(tile_counts[tile][0], rejected[part]);
            if (before + rejected[part] < before)
                atomicAdd(tile_counts[tile][1], 1u);
        }
    if (older.accepted == 0u || newer.accepted == 0u)
        atomicAdd(tile_counts[tile][2], 1u);
    if (uvec2(older.done, newer.done) != expected)
        atomicAdd(tile_counts[tile][3], 1u);
}

// Of the pixels of the region that touch one, and itself: k of nine, where the region ends beside it. The lower of two in
// the middle is wanted, that is the value with (k - 1) / 2 values below it, which is the fifth of nine if 4 - (k - 1) / 2
// of those that are missing lie below all, and the others above. A pixel alone has no neighbours.
Neighbourhood neighbourhood(ivec2 place, ivec2 size)
{
    const float below_all = -1.0;
    const float above_all = 3e38;
    ivec2 first = max(place - 1, ivec2(0));
    ivec2 last = min(place + 1, size - 1);
    int count = (last.x - first.x + 1) * (last.y - first.y + 1);
    int lows = 4 - (count - 1) / 2;
    float values[9];
    float largest = 0.0;
    [[unroll]] for (int i = 0; i < 9; ++i) {
        ivec2 other = place + ivec2(i % 3 - 1, i / 3 - 1);
        bool is_there = all(greaterThanEqual(other, first)) && all(lessThanEqual(other, last));
        float value = means[is_there ? other.y * int(REGION_SIZE) + other.x : 0];
        largest = max(largest, is_there ? value : 0.0);
        values[i] = is_there ? value : lows > 0 ? below_all : above_all;
        lows -= is_there ? 0 : 1;
    }
    float median = median_of_rows(sorted(values[0], values[1], values[2]), sorted(values[3], values[4], values[5]),
                                  sorted(values[6], values[7], values[8]));
    return Neighbourhood(count > 1 ? median : 0.0, largest);
}

// Of the pixels of its tile that touch a pixel, and itself.
float largest_in_tile(uvec2 place, uvec2 size)
{
    uvec2 corner = place / TILE_SIZE * TILE_SIZE;
    uvec2 first = max(place, corner + 1u) - 1u;
    uvec2 last = min(place + 1u, min(corner + TILE_SIZE, size) - 1u);
    float largest = 0.0;
    for (uint y = first.y; y <= last.y; ++y)
        for (uint x = first.x; x <= last.x; ++x)
            largest = max(largest, means[y * REGION_SIZE + x]);
    return largest;
}

// Sums of squares with the sum of the squares of their shares in them.
void add_squares(inout float sum, inout float shares, float other_sum, float other_shares)
{
    float all = sum + other_sum;
    shares = all > 0.0 ? (squared(sum / all) * shares + squared(other_sum / all) * other_shares) : 0.0;
    sum = all;
}

// Adds a tile with a part of the pixels that whole ones have to those of a region.
void add_tile(inout ErrorSquares region, float square, float pixel_shares, float part)
{
    float before = region.sum;
    add_squares(region.sum, region.pixel_shares, square, pixel_shares);
    float tiles = before;
    add_squares(tiles, region.tile_shares, square, 1.0);
    region.part_share = tiles > 0.0 ? (region.part_share * before + part * square) / tiles : 0.0;
}

void main()
{
    const uint invocation = gl_LocalInvocationID.x;
    const uvec2 region_place = gl_WorkGroupID.xy * REGION_SIZE;
    const uvec2 size = min(uvec2(estimate.film_width, estimate.row_count) - region_place, uvec2(REGION_SIZE));

    // The row of a tile that this invocation adds up.
    const uint tile = invocation / TILE_SIZE;
    const uvec2 row_place = uvec2(tile % TILES_IN_ROW, tile / TILES_IN_ROW) * TILE_SIZE
                          + uvec2(0u, invocation % TILE_SIZE);
    const uint row_first = row_place.y * REGION_SIZE + row_place.x;
    const uint row_pixels = row_place.y < size.y && row_place.x < size.x ? min(size.x - row_place.x, TILE_SIZE) : 0u;

    if (invocation < TILES_IN_REGION)
        tile_counts[invocation] = uint[4](0u, 0u, 0u, 0u);
    barrier();

    float unseen[PIXELS_OF_INVOCATION];
    vec2 own_squares[PIXELS_OF_INVOCATION];
    for (uint channel = 0u; channel < 3u; ++channel) {
        // What the samples of each pixel show.
        float standard_errors[PIXELS_OF_INVOCATION];
        float lessers[PIXELS_OF_INVOCATION];
        for (uint i = 0u; i < PIXELS_OF_INVOCATION; ++i) {
            uint index = i * ESTIMATE_WORKGROUP_SIZE + invocation;
            uvec2 place = uvec2(index % REGION_SIZE, index / REGION_SIZE);
            if (any(greaterThanEqual(place, size)))
                continue;
            uint pixel = (region_place.y + place.y) * estimate.film_width + region_place.x + place.x;
            PartCount older = part_count(estimate.older_part, pixel, estimate.strip_pixel_count);
            PartCount newer = part_count(1u - estimate.older_part, pixel, estimate.strip_pixel_count);
            Shown shown = shown_in(channel, pixel, counts_of(older, newer));
            means[index] = shown.mean;
            standard_errors[i] = shown.standard_error;
            lessers[i] = shown.lesser;
            if (channel == 0u) {
                count_in_tile(place.y / TILE_SIZE * TILES_IN_ROW + place.x / TILE_SIZE, older, newer,
                              expected_counts(region_place + place));
                squares[index] = 0.0;
                relative_squares[index] = 0.0;
                unseen[i] = 0.0;
                own_squares[i] = vec2(0.0);
            }
        }
        barrier();

        // What the pixels are on the average: of rows of tiles, then of tiles, then of the region.
        ValueSet row_set = empty_set();
        for (uint i = 0u; i < row_pixels; ++i)
            row_set = with_value(row_set, means[row_first + i]);
        rows[invocation] = vec4(row_set.sum, row_set.count, row_set.largest, row_set.second);
        barrier();
        if (invocation < TILES_IN_REGION) {
            ValueSet tile_set = empty_set();
            for (uint i = 0u; i < TILE_SIZE; ++i) {
                vec4 row = rows[invocation * TILE_SIZE + i];
                tile_set = united(tile_set, ValueSet(row.x, row.y, row.z, row.w));
            }
            tile_sets[invocation] = tile_set;
        }
        barrier();
        ValueSet region_set = empty_set();
        for (uint i = 0u; i < TILES_IN_REGION; ++i)
            region_set = united(region_set, tile_sets[i]);

        // What is expected of each pixel's error.
        for (uint i = 0u; i < PIXELS_OF_INVOCATION; ++i) {
            uint index = i * ESTIMATE_WORKGROUP_SIZE + invocation;
            uvec2 place = uvec2(index % REGION_SIZE, index / REGION_SIZE);
            if (any(greaterThanEqual(place, size)))
                continue;
            // As it was stored: of what sets have, it must be the same number.
            float mean = means[index];
            Neighbourhood near = neighbourhood(ivec2(place), ivec2(size));
            ValueSet tile_set = tile_sets[place.y / TILE_SIZE * TILES_IN_ROW + place.x / TILE_SIZE];
            float around = max(near.median, level_about(mean, tile_set, region_set));
            RelativeError relative = RelativeError(estimate.relative_offset, estimate.relative_scale);
            uvec2 counts = expected_counts(region_place + place);
            squares[index] += squared(standard_errors[i]);
            relative_squares[index] += relative_square(standard_errors[i], mean, lessers[i], around, relative);
            unseen[i] += unseen_square(mean, near.largest, float(counts.x + counts.y), estimate.relative_offset);
            if (UNEVEN == 1u)
                own_squares[i] += vec2(
                    relative_square(standard_errors[i], mean, lessers[i],
                                    mean_besides_and_without_largest(tile_set, mean), relative),
                    unseen_square(mean, largest_in_tile(place, size), float(counts.x + counts.y), relative.offset));
        }
        barrier(); // before the next channel's means
    }
    for (uint i = 0u; i < PIXELS_OF_INVOCATION; ++i)
        means[i * ESTIMATE_WORKGROUP_SIZE + invocation] = unseen[i];
    barrier();

    // Sums of rows of tiles, then of each tile.
    vec4 row = vec4(0.0);
    float row_unseen = 0.0;
    for (uint i = 0u; i < row_pixels; ++i) {
        add_squares(row.x, row.y, squares[row_first + i], 1.0);
        add_squares(row.z, row.w, relative_squares[row_first + i], 1.0);
        row_unseen += means[row_first + i];
    }
    barrier(); // all have read the pixels
    rows[invocation] = row;
    means[invocation] = row_unseen;
    barrier();
    if (invocation < TILES_IN_REGION) {
        vec4 sum = vec4(0.0);
        float tile_unseen = 0.0;
        for (uint i = 0u; i < TILE_SIZE; ++i) {
            vec4 other = rows[invocation * TILE_SIZE + i];
            add_squares(sum.x, sum.y, other.x, other.y);
            add_squares(sum.z, sum.w, other.z, other.w);
            tile_unseen += means[invocation * TILE_SIZE + i];
        }
        squares[invocation] = sum.x;
        squares[TILES_IN_REGION + invocation] = sum.y;
        relative_squares[invocation] = sum.z;
        relative_squares[TILES_IN_REGION + invocation] = sum.w;
        means[PIXELS_IN_REGION - 1u - invocation] = tile_unseen; // beyond those of rows
    }
    barrier();

    // And of tiles.
    if (invocation == 0u) {
        RegionError region;
        region.square = ErrorSquares(0.0, 0.0, 0.0, 0.0);
        region.relative_square = ErrorSquares(0.0, 0.0, 0.0, 0.0);
        region.unseen = 0.0;
        region.unknown_pixels = 0u;
        region.lost_pixels = 0u;
        region.reserved = 0u;
        region.rejected = uvec2(0u);
        for (uint i = 0u; i < TILES_IN_REGION; ++i) {
            // The pixels of a tile that the region has, of those of a whole one.
            uvec2 corner = uvec2(i % TILES_IN_ROW, i / TILES_IN_ROW) * TILE_SIZE;
            uvec2 in_region = min(size - min(size, corner), uvec2(TILE_SIZE));
            float part = float(in_region.x * in_region.y) / float(TILE_SIZE * TILE_SIZE);
            add_tile(region.square, squares[i], squares[TILES_IN_REGION + i], part);
            add_tile(region.relative_square, relative_squares[i], relative_squares[TILES_IN_REGION + i], part);
            region.unseen += means[PIXELS_IN_REGION - 1u - i];
            uint carry;
            region.rejected.x = uaddCarry(region.rejected.x, tile_counts[i][0], carry);
            region.rejected.y += tile_counts[i][1] + carry;
            region.unknown_pixels += tile_counts[i][2];
            region.lost_pixels += tile_counts[i][3];
        }
        estimated.regions[gl_WorkGroupID.y * gl_NumWorkGroups.x + gl_WorkGroupID.x] = region;
    }
    if (UNEVEN == 0u)
        return;

    // What tiles say of themselves, in the same order.
    barrier(); // the region has been written
    for (uint i = 0u; i < PIXELS_OF_INVOCATION; ++i) {
        means[i * ESTIMATE_WORKGROUP_SIZE + invocation] = own_squares[i].x;
        squares[i * ESTIMATE_WORKGROUP_SIZE + invocation] = own_squares[i].y;
    }
    barrier();
    vec2 row_squares = vec2(0.0);
    for (uint i = 0u; i < row_pixels; ++i)
        row_squares += vec2(means[row_first + i], squares[row_first + i]);
    rows[invocation].xy = row_squares;
    barrier();
    uvec2 tile_place = uvec2(invocation % TILES_IN_ROW, invocation / TILES_IN_ROW) * TILE_SIZE;
    if (invocation < TILES_IN_REGION && all(lessThan(tile_place, size))) {
        vec2 tile_squares = vec2(0.0);
        for (uint i = 0u; i < TILE_SIZE; ++i)
            tile_squares += rows[invocation * TILE_SIZE + i].xy;
        // Where both parts of some pixel do not have a sample, nothing is known.
        tile_errors.squares[film_tile(region_place + tile_place)] =
            tile_counts[invocation][2] > 0u ? vec2(uintBitsToFloat(INFINITY_BITS)) : tile_squares;
    }
}
