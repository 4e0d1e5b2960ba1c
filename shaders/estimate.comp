// Sums up what the pixels of a film say about the error of its image: one workgroup per region. A region depends on
// nothing outside it, and every sum has its order, so that a film always gives the same bits.
#version 450
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_control_flow_attributes : require

#include "gpu_layout.h"

layout(local_size_x = ESTIMATE_WORKGROUP_SIZE) in;
layout(push_constant) uniform Push { EstimateConstants estimate; };

#include "error_squares.glsl"
#include "film_parts.glsl"
#include "neighbourhood.h"
#include "pixel_error.h"
#include "quotient.h"

layout(set = 0, binding = BINDING_RESOLVED) writeonly buffer Regions { RegionError regions[]; } estimated;

// For each tile: its samples in the older and the newer part, where tiles differ. And on request, what its own samples
// say about the sum of the squares of its relative errors, and about that of light that no sample has met.
layout(set = 0, binding = BINDING_TILE_COUNTS) readonly buffer TileCounts { uvec2 counts[]; } tile_samples;
layout(set = 0, binding = BINDING_TILE_SQUARES) writeonly buffer TileSquares { vec2 squares[]; } tile_errors;

const uint TILES_IN_ROW = REGION_SIZE / TILE_SIZE;
const uint TILES_IN_REGION = TILES_IN_ROW * TILES_IN_ROW;

// What pixels have besides their sums.
struct Findings {
    uvec2 rejected; // samples, low and high word
    uint unknown;   // pixels without a sample in either part
    uint lost;      // pixels that do not have the samples expected
};

// The kinds of squares in RegionError of gpu_layout.h.
const uint SQUARE = 0u;
const uint RELATIVE_SQUARE = 1u;
const uint MET_ONCE = 2u;
const uint AS_LAMPS = 3u;
const uint KINDS = 4u;
const uint FIRST_RARE_KIND = MET_ONCE; // from here on, few pixels have squares
const uint RARE_KINDS = KINDS - FIRST_RARE_KIND;

// What a column of a tile, and later a whole tile, says about the errors of its pixels.
struct Errors {
    Squares squares[KINDS];
    uint met_again; // values
    float unseen;
    vec2 own; // what the samples of its tile alone say: relative squares, and those of unseen light
    Findings findings;
};

// Each invocation handles one column of a tile, so the invocations of one row of pixels read adjacent memory.
shared float means[REGION_SIZE][REGION_SIZE]; // of one channel, by row and column
shared ValueSet column_sets[ESTIMATE_WORKGROUP_SIZE];
shared ValueSet tile_sets[TILES_IN_REGION];
shared Errors errors[ESTIMATE_WORKGROUP_SIZE]; // of columns, and then of tiles

// Squares of the rare kinds, for the pixels of each invocation, over all channels. In shared memory and not in
// registers, since most regions have none: in registers a target of 1% took 1.04 times as long on an H100 (1024x512
// pixels, two vertices).
shared float rare_squares[RARE_KINDS][TILE_SIZE][ESTIMATE_WORKGROUP_SIZE];

// How many pixels are requested from memory before the first is waited for. Measured on an H200: with 1024x512 pixels
// an error took 89 us with 1, 84 with 2 and 83 with 4; with twice as many pixels 151, 147 and 134.
const uint PIXELS_ASKED_FOR = 4u;

// A whole number of 2^-60ths as a float.
float as_float(WholeNumber number)
{
    return float(number.words[0]) * exp2(-60.0) + float(number.words[1]) * exp2(-28.0)
         + float(number.words[2]) * exp2(4.0) + float(number.words[3]) * exp2(36.0)
         + float(number.words[4]) * exp2(68.0);
}

float as_float(uvec4 sum)
{
    return as_float(whole_number(sum));
}

// What the samples of a pixel show in one channel.
struct Shown {
    float mean;
    float standard_error;
    float lesser; // of the means of the parts
};

// The standard error is the difference of the sums, each multiplied by the other's count, times a scale (quotient.h).
Shown shown_by(uvec4 sum_a, uvec4 sum_b, uvec2 counts)
{
    bool first_is_less;
    WholeNumber difference = weighted_difference(sum_a, counts.x, sum_b, counts.y, first_is_less);
    float a = float(counts.x);
    float b = float(counts.y);
    float scale = inversesqrt(a) * inversesqrt(b) / (a + b);
    return Shown(as_float(add_with_carry(sum_a, sum_b)) / float(counts.x + counts.y), as_float(difference) * scale,
                 first_is_less ? as_float(sum_a) / a : as_float(sum_b) / b);
}

// The index of a tile in the film.
uint film_tile(uvec2 place_in_strip)
{
    uint columns = (estimate.film_width + TILE_SIZE - 1u) / TILE_SIZE;
    return estimate.first_tile + place_in_strip.y / TILE_SIZE * columns + place_in_strip.x / TILE_SIZE;
}

Findings united(Findings a, Findings b)
{
    uint carry;
    a.rejected.x = uaddCarry(a.rejected.x, b.rejected.x, carry);
    a.rejected.y += b.rejected.y + carry;
    a.unknown += b.unknown;
    a.lost += b.lost;
    return a;
}

Findings findings_of(PartCount older, PartCount newer, uvec2 expected)
{
    uint carry;
    uvec2 rejected;
    rejected.x = uaddCarry(older.done - older.accepted, newer.done - newer.accepted, carry);
    rejected.y = carry;
    return Findings(rejected, older.accepted == 0u || newer.accepted == 0u ? 1u : 0u,
                    uvec2(older.done, newer.done) != expected ? 1u : 0u);
}

// The sorted values to the left of a pixel, in it and to its right.
Sorted row_about(ivec2 place, ivec2 size)
{
    float left = place.x > 0 ? means[place.y][max(place.x, 1) - 1] : BELOW_ALL;
    float right = place.x + 1 < size.x ? means[place.y][min(place.x, int(REGION_SIZE) - 2) + 1] : BELOW_ALL;
    return sorted(left, means[place.y][place.x], right);
}

// For a region of a single row or column.
Neighbourhood neighbourhood_in_line(ivec2 place, ivec2 size)
{
    ivec2 along = size.x > 1 ? ivec2(1, 0) : ivec2(0, 1);
    ivec2 before = place - along;
    ivec2 behind = place + along;
    return neighbourhood_in_line(all(greaterThanEqual(before, ivec2(0))) ? means[before.y][before.x] : BELOW_ALL,
                                 means[place.y][place.x],
                                 all(lessThan(behind, size)) ? means[behind.y][behind.x] : BELOW_ALL);
}

// The largest value among a pixel and the pixels of its tile that touch it.
float largest_in_tile(uvec2 place, uvec2 size)
{
    uvec2 corner = place / TILE_SIZE * TILE_SIZE;
    uvec2 first = max(place, corner + 1u) - 1u;
    uvec2 last = min(place + 1u, min(corner + TILE_SIZE, size) - 1u);
    float largest = 0.0;
    for (uint y = first.y; y <= last.y; ++y)
        for (uint x = first.x; x <= last.x; ++x)
            largest = max(largest, means[y][x]);
    return largest;
}

// The sum over the pixels of an invocation that have such squares.
Squares rare_squares_of(uint kind, uint invocation, uint with_rare)
{
    if (with_rare == 0u)
        return Squares(0.0, 0.0);
    float values[TILE_SIZE];
    [[unroll]] for (uint i = 0u; i < TILE_SIZE; ++i)
        values[i] = (with_rare & 1u << i) != 0u ? rare_squares[kind - FIRST_RARE_KIND][i][invocation] : 0.0;
    return squares_of(values);
}

// The sum over all tiles of a region, with the part of a whole tile that each covers.
ErrorSquares squares_of_tiles(uint kind, uvec2 size)
{
    ErrorSquares all = ErrorSquares(0.0, 0.0, 0.0, 0.0);
    [[unroll]] for (uint i = 0u; i < TILES_IN_REGION; ++i)
        all.sum += errors[i].squares[kind].sum;
    if (all.sum > 0.0)
        [[unroll]] for (uint i = 0u; i < TILES_IN_REGION; ++i) {
            uvec2 corner = uvec2(i % TILES_IN_ROW, i / TILES_IN_ROW) * TILE_SIZE;
            uvec2 in_region = min(size - min(size, corner), uvec2(TILE_SIZE));
            float share = share_of(errors[i].squares[kind].sum, all.sum);
            all.pixel_shares += squared(share) * errors[i].squares[kind].shares;
            all.tile_shares += squared(share);
            all.part_share += share * (float(in_region.x * in_region.y) / float(TILE_SIZE * TILE_SIZE));
        }
    return all;
}

// Writes what the tiles add up to. One invocation for each kind of squares; the first one writes everything else as
// well.
void write_region_error(uint region, uint invocation, uvec2 size)
{
    if (invocation < KINDS) {
        ErrorSquares squares = squares_of_tiles(invocation, size);
        if (invocation == SQUARE)
            estimated.regions[region].square = squares;
        else if (invocation == RELATIVE_SQUARE)
            estimated.regions[region].relative_square = squares;
        else if (invocation == MET_ONCE)
            estimated.regions[region].met_once = squares;
        else
            estimated.regions[region].as_lamps = squares;
    }
    if (invocation == 0u) {
        Findings findings = Findings(uvec2(0u), 0u, 0u);
        float unseen = 0.0;
        uint met_again = 0u;
        for (uint i = 0u; i < TILES_IN_REGION; ++i) {
            unseen += errors[i].unseen;
            met_again += errors[i].met_again;
            findings = united(findings, errors[i].findings);
        }
        estimated.regions[region].unseen = unseen;
        estimated.regions[region].met_again = met_again;
        estimated.regions[region].rejected = findings.rejected;
        estimated.regions[region].unknown_pixels = findings.unknown;
        estimated.regions[region].lost_pixels = findings.lost;
    }
}

void main()
{
    const uint invocation = gl_LocalInvocationID.x;
    const uvec2 region_place = gl_WorkGroupID.xy * REGION_SIZE;
    const uvec2 size = min(uvec2(estimate.film_width, estimate.row_count) - region_place, uvec2(REGION_SIZE));

    // The pixels of this invocation, one below the other, and their tile. Pixels outside the region are replaced by its
    // first one.
    const uvec2 place = uvec2(invocation % REGION_SIZE, invocation / REGION_SIZE * TILE_SIZE);
    const uint pixels = place.x < size.x ? min(size.y - min(size.y, place.y), TILE_SIZE) : 0u;
    const uvec2 first_place = region_place + (pixels > 0u ? place : uvec2(0u));
    const uint first_pixel = first_place.y * estimate.film_width + first_place.x;
    const uint last = max(pixels, 1u) - 1u;
    const uint tile = place.y / TILE_SIZE * TILES_IN_ROW + place.x / TILE_SIZE;

    // Whether this invocation sums up a tile, which one, and its first column; columns of a tile are consecutive.
    const bool sums_up_tile = invocation < TILES_IN_REGION;
    const uvec2 tile_place = uvec2(invocation % TILES_IN_ROW, invocation / TILES_IN_ROW) * TILE_SIZE;
    const uint first_column = sums_up_tile ? tile_place.y / TILE_SIZE * REGION_SIZE + tile_place.x : 0u;

    // How many samples pixels have.
    const bool are_even = estimate.sample_counts != uvec2(ANY_COUNT);
    const uvec2 expected = are_even ? estimate.sample_counts : tile_samples.counts[film_tile(first_place)];
    const float sample_count = float(expected.x + expected.y);
    uvec2 counts[TILE_SIZE];
    Findings findings = Findings(uvec2(0u), 0u, 0u);
    PartCount parts[FILM_PARTS][TILE_SIZE];
    [[unroll]] for (uint i = 0u; i < TILE_SIZE; ++i) {
        uint pixel = first_pixel + min(i, last) * estimate.film_width;
        parts[0][i] = part_count(0u, pixel, estimate.strip_pixel_count);
        parts[1][i] = part_count(1u, pixel, estimate.strip_pixel_count);
    }
    [[unroll]] for (uint i = 0u; i < TILE_SIZE; ++i) {
        counts[i] = uvec2(parts[0][i].accepted, parts[1][i].accepted);
        if (i < pixels)
            findings = united(findings, findings_of(parts[0][i], parts[1][i], expected));
    }

    const float offset_square = squared(estimate.relative_offset);
    float squares[FIRST_RARE_KIND][TILE_SIZE]; // of all channels
    [[unroll]] for (uint kind = 0u; kind < FIRST_RARE_KIND; ++kind)
        [[unroll]] for (uint i = 0u; i < TILE_SIZE; ++i)
            squares[kind][i] = 0.0;
    uint with_rare = 0u; // bits of pixels
    uint met_again = 0u;
    float unseen = 0.0;
    vec2 own = vec2(0.0);
    for (uint channel = 0u; channel < 3u; ++channel) {
        // What the samples of each pixel show.
        float standard_errors[TILE_SIZE];
        float lessers[TILE_SIZE];
        [[unroll]] for (uint first = 0u; first < TILE_SIZE; first += PIXELS_ASKED_FOR) {
            uvec4 sums[FILM_PARTS][PIXELS_ASKED_FOR];
            [[unroll]] for (uint i = 0u; i < PIXELS_ASKED_FOR; ++i) {
                uint pixel = first_pixel + min(first + i, last) * estimate.film_width;
                sums[0][i] = part_sum(0u, channel, pixel, estimate.strip_pixel_count);
                sums[1][i] = part_sum(1u, channel, pixel, estimate.strip_pixel_count);
            }
            [[unroll]] for (uint i = 0u; i < PIXELS_ASKED_FOR; ++i)
                if (first + i < pixels) {
                    Shown shown = shown_by(sums[0][i], sums[1][i], counts[first + i]);
                    means[place.y + first + i][place.x] = shown.mean;
                    standard_errors[first + i] = shown.standard_error;
                    lessers[first + i] = shown.lesser;
                }
        }

        barrier();

        // What the pixels are on the average: of columns of tiles, then of tiles, then of the region. Means are taken
        // as they were stored, behind a barrier, lest a driver rounds the same mean in two ways: who asks a set about
        // one of its values must have the same number.
        ValueSet column_set = empty_set();
        for (uint i = 0u; i < pixels; ++i)
            column_set = with_value(column_set, means[place.y + i][place.x]);
        column_sets[invocation] = column_set;
        barrier();
        if (sums_up_tile) {
            ValueSet tile_set = empty_set();
            [[unroll]] for (uint i = 0u; i < TILE_SIZE; ++i)
                tile_set = united(tile_set, column_sets[first_column + i]);
            tile_sets[invocation] = tile_set;
        }
        barrier();
        ValueSet region_set = empty_set();
        for (uint i = 0u; i < TILES_IN_REGION; ++i)
            region_set = united(region_set, tile_sets[i]);
        const ValueSet tile_set = tile_sets[tile];

        // The expected error of each pixel. The rows around it are kept from pixel to pixel.
        const bool is_line = size.x == 1u || size.y == 1u;
        const ivec2 bounds = ivec2(size);
        const Sorted none = Sorted(0.0, 0.0, 0.0);
        Sorted above = pixels > 0u && place.y > 0u ? row_about(ivec2(place) - ivec2(0, 1), bounds) : none;
        Sorted row = pixels > 0u ? row_about(ivec2(place), bounds) : none;
        [[unroll]] for (uint i = 0u; i < TILE_SIZE; ++i)
            if (i < pixels) {
                const ivec2 at = ivec2(place) + ivec2(0, i);
                const float mean = means[at.y][at.x];
                const float standard_error = standard_errors[i];
                const float scaled_error = standard_error * estimate.relative_scale;
                const bool is_last_row = at.y + 1 == bounds.y;
                const Sorted below = is_last_row ? none : row_about(at + ivec2(0, 1), bounds);
                const Neighbourhood near =
                    is_line ? neighbourhood_in_line(at, bounds)
                            : neighbourhood(above, row, below, at.y == 0, is_last_row, at.x == 0 || at.x == bounds.x - 1);
                above = row;
                row = below;
                const float around = max(near.median, level_about(mean, tile_set, region_set));
                squares[SQUARE][i] += squared(standard_error);
                const Limit limit = limit_of(standard_error, mean, lessers[i], around, offset_square);
                const float square = relative_square(scaled_error, limit);
                const bool once = is_met_once(standard_error, mean, lessers[i]);
                if (limit.alone > 0.0 && once) {
                    const vec2 rare = vec2(square, square_as_lamp(scaled_error, mean, offset_square));
                    const bool is_first = (with_rare & 1u << i) == 0u;
                    [[unroll]] for (uint kind = 0u; kind < RARE_KINDS; ++kind)
                        rare_squares[kind][i][invocation] =
                            (is_first ? 0.0 : rare_squares[kind][i][invocation]) + rare[kind];
                    with_rare |= 1u << i;
                } else
                    squares[RELATIVE_SQUARE][i] += square;
                met_again += limit.alone > 0.0 && !once && is_met_again(mean, lessers[i]) ? 1u : 0u;
                unseen += unseen_square(mean, near.largest, sample_count, offset_square);
                if (estimate.by_tile == 1u) {
                    const float level = mean_besides_and_without_largest(tile_set, mean);
                    const Limit of_tile = limit_of(standard_error, mean, lessers[i], level, offset_square);
                    own += vec2(once && of_tile.alone > 0.0 ? square_as_lamp(scaled_error, mean, offset_square)
                                                            : relative_square(scaled_error, of_tile),
                                unseen_square(mean, largest_in_tile(uvec2(at), size), sample_count, offset_square));
                }
            }
        barrier(); // before the next channel's means
    }

    // Sums of columns of tiles, then of tiles, then of the region.
    [[unroll]] for (uint kind = 0u; kind < FIRST_RARE_KIND; ++kind)
        errors[invocation].squares[kind] = squares_of(squares[kind]);
    for (uint kind = FIRST_RARE_KIND; kind < KINDS; ++kind)
        errors[invocation].squares[kind] = rare_squares_of(kind, invocation, with_rare);
    errors[invocation].met_again = met_again;
    errors[invocation].unseen = unseen;
    errors[invocation].own = own;
    errors[invocation].findings = findings;
    barrier();
    // An invocation sums up one kind of squares of a tile; one invocation for each tile sums up everything else.
    const uint summed_tile = invocation % TILES_IN_REGION;
    const uint kind = min(invocation / TILES_IN_REGION, KINDS - 1u);
    const uint first = summed_tile / TILES_IN_ROW * REGION_SIZE + summed_tile % TILES_IN_ROW * TILE_SIZE;
    Squares of_kind = errors[first].squares[kind];
    for (uint i = 1u; i < TILE_SIZE; ++i)
        of_kind = united(of_kind, errors[first + i].squares[kind]);
    Errors of_tile = errors[first];
    if (sums_up_tile)
        for (uint i = 1u; i < TILE_SIZE; ++i) {
            of_tile.met_again += errors[first + i].met_again;
            of_tile.unseen += errors[first + i].unseen;
            of_tile.own += errors[first + i].own;
            of_tile.findings = united(of_tile.findings, errors[first + i].findings);
        }
    barrier(); // all have read the columns
    if (invocation < KINDS * TILES_IN_REGION)
        errors[summed_tile].squares[kind] = of_kind;
    if (sums_up_tile) {
        errors[invocation].met_again = of_tile.met_again;
        errors[invocation].unseen = of_tile.unseen;
        errors[invocation].findings = of_tile.findings;
    }
    barrier();
    write_region_error(gl_WorkGroupID.y * gl_NumWorkGroups.x + gl_WorkGroupID.x, invocation, size);

    // What tiles say about themselves. If a pixel lacks samples in one of the parts, nothing is known.
    if (estimate.by_tile == 1u && sums_up_tile && all(lessThan(tile_place, size)))
        tile_errors.squares[film_tile(region_place + tile_place)] =
            of_tile.findings.unknown > 0u ? vec2(infinity) : of_tile.own;
}
