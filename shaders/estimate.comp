// Sums the errors of pixels. The order of additions is fixed, so a film always gives the same bits.
#version 450
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_control_flow_attributes : require

#include "gpu_layout.h"

layout(local_size_x = ESTIMATE_WORKGROUP_SIZE) in;
layout(push_constant) uniform Push { EstimateConstants estimate; };

#include "film_parts.glsl"
#include "neighbourhood.h"
#include "pixel_error.h"
#include "quotient.h"

layout(set = 0, binding = BINDING_RESOLVED) writeonly buffer Groups { TileErrors groups[]; } estimated;

// `counts` has the samples of each tile in the older and the newer part, if tiles differ. With estimate.by_tile,
// `squares` receives each tile's squared relative errors: x from samples, y from unseen light.
layout(set = 0, binding = BINDING_TILE_COUNTS) readonly buffer TileCounts { uvec2 counts[]; } tile_samples;
layout(set = 0, binding = BINDING_TILE_SQUARES) writeonly buffer TileSquares { vec2 squares[]; } tile_squares;

const uint TILES = ESTIMATE_WORKGROUP_SIZE / TILE_SIZE;

struct Findings {
    uvec2 rejected;
    uint unknown;
    uint lost;
};

const uint SQUARE = 0u;
const uint RELATIVE_SQUARE = 1u;
const uint MET_ONCE = 2u;
const uint AS_LAMPS = 3u;
const uint SQUARE_KINDS = 4u;

struct Squares {
    float sum;
    float shares; // sum of (pixel's value / sum)^2
};

// Sums over a column of a tile, and finally over the tile.
struct Errors {
    Squares squares[SQUARE_KINDS];
    uint met_again;
    float unseen;
    Findings findings;
};

// Each invocation has one column of a tile, so that invocations read adjacent words.
shared float means[TILE_SIZE][ESTIMATE_WORKGROUP_SIZE]; // means of one channel
shared ValueSet column_sets[ESTIMATE_WORKGROUP_SIZE];
shared Errors errors[ESTIMATE_WORKGROUP_SIZE];

// Pixels that an invocation fetches at once, which is faster on GPUs.
const uint PIXELS_ASKED_FOR = 4u;

// number is in units of 2^-60.
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

struct Shown {
    float mean;
    float standard_error;
    float lesser; // lower mean of the two parts
};

// quotient.h derives the scale of the difference.
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

Sorted row_about(uint y, uint column, uint first, uint last)
{
    float left = column > first ? means[y][max(column, 1u) - 1u] : BELOW_ALL;
    float right = column < last ? means[y][min(column, ESTIMATE_WORKGROUP_SIZE - 2u) + 1u] : BELOW_ALL;
    return sorted(left, means[y][column], right);
}

// part / sum for sum != 0. If they are equal, the result is exactly 1, because the host subtracts such fractions.
float share_of(float part, float sum)
{
    return part == sum ? 1.0 : part / sum;
}

Squares squares_of(float values[TILE_SIZE])
{
    Squares all = Squares(0.0, 0.0);
    [[unroll]] for (uint i = 0u; i < TILE_SIZE; ++i)
        all.sum += values[i];
    [[unroll]] for (uint i = 0u; i < TILE_SIZE; ++i)
        all.shares += all.sum > 0.0 ? squared(share_of(values[i], all.sum)) : 0.0;
    return all;
}

Squares united(Squares a, Squares b)
{
    float sum = a.sum + b.sum;
    return Squares(sum, sum > 0.0 ? squared(share_of(a.sum, sum)) * a.shares + squared(share_of(b.sum, sum)) * b.shares
                                  : 0.0);
}

ErrorSquares squares_of_tiles(uint kind, uvec2 size)
{
    ErrorSquares all = ErrorSquares(0.0, 0.0, 0.0, 0.0);
    [[unroll]] for (uint i = 0u; i < TILES; ++i)
        all.sum += errors[i].squares[kind].sum;
    if (all.sum > 0.0)
        [[unroll]] for (uint i = 0u; i < TILES; ++i) {
            uint width = min(size.x - min(size.x, i * TILE_SIZE), TILE_SIZE);
            float share = share_of(errors[i].squares[kind].sum, all.sum);
            all.pixel_shares += squared(share) * errors[i].squares[kind].shares;
            all.tile_shares += squared(share);
            all.part_share += share * (float(width * size.y) / float(TILE_SIZE * TILE_SIZE));
        }
    return all;
}

void write_errors(uint group, uint invocation, uvec2 size)
{
    if (invocation < SQUARE_KINDS) {
        ErrorSquares squares = squares_of_tiles(invocation, size);
        if (invocation == SQUARE)
            estimated.groups[group].square = squares;
        else if (invocation == RELATIVE_SQUARE)
            estimated.groups[group].relative_square = squares;
        else if (invocation == MET_ONCE)
            estimated.groups[group].met_once = squares;
        else
            estimated.groups[group].as_lamps = squares;
    }
    if (invocation == 0u) {
        Findings findings = Findings(uvec2(0u), 0u, 0u);
        float unseen = 0.0;
        uint met_again = 0u;
        for (uint i = 0u; i < TILES; ++i) {
            unseen += errors[i].unseen;
            met_again += errors[i].met_again;
            findings = united(findings, errors[i].findings);
        }
        estimated.groups[group].unseen = unseen;
        estimated.groups[group].met_again = met_again;
        estimated.groups[group].rejected = findings.rejected;
        estimated.groups[group].unknown_pixels = findings.unknown;
        estimated.groups[group].lost_pixels = findings.lost;
    }
}

void main()
{
    const uint invocation = gl_LocalInvocationID.x;
    const uvec2 corner = gl_WorkGroupID.xy * uvec2(ESTIMATE_WORKGROUP_SIZE, TILE_SIZE);
    const uvec2 size =
        min(uvec2(estimate.film_width, estimate.row_count) - corner, uvec2(ESTIMATE_WORKGROUP_SIZE, TILE_SIZE));
    const uint first_tile = estimate.first_tile + corner.x / TILE_SIZE
                          + gl_WorkGroupID.y * ((estimate.film_width + TILE_SIZE - 1u) / TILE_SIZE);

    // Invocations outside the film read a pixel inside.
    const uint pixels = invocation < size.x ? size.y : 0u;
    const uint first_pixel = corner.y * estimate.film_width + corner.x + (pixels > 0u ? invocation : 0u);
    const uint last = size.y - 1u;
    const uint first_column = invocation / TILE_SIZE * TILE_SIZE;
    const uint last_column = min(first_column + TILE_SIZE, size.x) - 1u;

    const bool are_even = estimate.sample_counts != uvec2(ANY_COUNT);
    const uvec2 expected = are_even     ? estimate.sample_counts
                         : pixels > 0u ? tile_samples.counts[first_tile + invocation / TILE_SIZE]
                                       : uvec2(0u);
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
    float squares[SQUARE_KINDS][TILE_SIZE];
    [[unroll]] for (uint kind = 0u; kind < SQUARE_KINDS; ++kind)
        [[unroll]] for (uint i = 0u; i < TILE_SIZE; ++i)
            squares[kind][i] = 0.0;
    uint met_again = 0u;
    float unseen = 0.0;
    for (uint channel = 0u; channel < 3u; ++channel) {
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
                    means[first + i][invocation] = shown.mean;
                    standard_errors[first + i] = shown.standard_error;
                    lessers[first + i] = shown.lesser;
                }
        }
        barrier();

        // Value sets of columns, then of tiles. Means are read back, because recomputed ones may round differently.
        ValueSet column_set = empty_set();
        for (uint i = 0u; i < pixels; ++i)
            column_set = with_value(column_set, means[i][invocation]);
        column_sets[invocation] = column_set;
        barrier();
        ValueSet tile_set = empty_set();
        [[unroll]] for (uint i = 0u; i < TILE_SIZE; ++i)
            tile_set = united(tile_set, column_sets[first_column + i]);

        const bool is_row = size.y == 1u;
        const bool is_column = first_column == last_column;
        const bool is_beside_edge = invocation == first_column || invocation == last_column;
        const Sorted none = Sorted(0.0, 0.0, 0.0);
        Sorted above = none;
        Sorted row = pixels > 0u ? row_about(0u, invocation, first_column, last_column) : none;
        [[unroll]] for (uint i = 0u; i < TILE_SIZE; ++i)
            if (i < pixels) {
                const float mean = means[i][invocation];
                const float standard_error = standard_errors[i];
                const float scaled_error = standard_error * estimate.relative_scale;
                const bool is_last_row = i == last;
                const Sorted below = is_last_row ? none : row_about(i + 1u, invocation, first_column, last_column);
                const Neighbourhood near = is_row || is_column
                    ? neighbourhood_in_line(is_row ? row : column_of(above, row, below, i == 0u, is_last_row))
                    : neighbourhood(above, row, below, i == 0u, is_last_row, is_beside_edge);
                above = row;
                row = below;
                squares[SQUARE][i] += squared(standard_error);
                const Limit limit = limit_of(standard_error, mean, lessers[i],
                                             around(mean, tile_set, near.median, near.largest), offset_square);
                const float square = relative_square(scaled_error, limit);
                const bool once = is_met_once(standard_error, mean, lessers[i]);
                if (limit.alone > 0.0 && once) {
                    squares[MET_ONCE][i] += square;
                    squares[AS_LAMPS][i] += square_as_lamp(scaled_error, mean, offset_square);
                } else
                    squares[RELATIVE_SQUARE][i] += square;
                met_again += limit.alone > 0.0 && !once && is_met_again(mean, lessers[i]) ? 1u : 0u;
                unseen += unseen_square(mean, near.largest, sample_count, offset_square);
            }
        barrier();
    }

    [[unroll]] for (uint kind = 0u; kind < SQUARE_KINDS; ++kind)
        errors[invocation].squares[kind] = squares_of(squares[kind]);
    errors[invocation].met_again = met_again;
    errors[invocation].unseen = unseen;
    errors[invocation].findings = findings;
    barrier();
    // Each invocation sums one kind of squares of a tile. One invocation per tile sums the rest.
    const uint tile = invocation % TILES;
    const uint kind = min(invocation / TILES, SQUARE_KINDS - 1u);
    const uint first = tile * TILE_SIZE;
    Squares of_kind = errors[first].squares[kind];
    for (uint i = 1u; i < TILE_SIZE; ++i)
        of_kind = united(of_kind, errors[first + i].squares[kind]);
    Errors of_tile = errors[first];
    if (invocation < TILES)
        for (uint i = 1u; i < TILE_SIZE; ++i) {
            of_tile.met_again += errors[first + i].met_again;
            of_tile.unseen += errors[first + i].unseen;
            of_tile.findings = united(of_tile.findings, errors[first + i].findings);
        }
    barrier();
    if (invocation < SQUARE_KINDS * TILES)
        errors[tile].squares[kind] = of_kind;
    if (invocation < TILES) {
        errors[tile].met_again = of_tile.met_again;
        errors[tile].unseen = of_tile.unseen;
        errors[tile].findings = of_tile.findings;
    }
    barrier();
    write_errors(gl_WorkGroupID.y * gl_NumWorkGroups.x + gl_WorkGroupID.x, invocation, size);

    // A tile's error is infinite if one of its pixels lacks samples in a part.
    if (estimate.by_tile == 1u && invocation < TILES && first < size.x)
        tile_squares.squares[first_tile + tile] =
            of_tile.findings.unknown > 0u
                ? vec2(infinity)
                : vec2(errors[tile].squares[RELATIVE_SQUARE].sum + errors[tile].squares[AS_LAMPS].sum, of_tile.unseen);
}
