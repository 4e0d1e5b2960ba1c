// A pixel and its neighbors in its tile, in one channel. Values are >= 0. The host too uses float32, because values are
// only compared.
#ifndef PT_NEIGHBOURHOOD_H
#define PT_NEIGHBOURHOOD_H

#include "dialects.h"

#ifdef __cplusplus
namespace pt::gpu {
#endif

// The value of a neighbor outside the tile.
PT_CONSTANT float BELOW_ALL = -1.0f;

struct Sorted {
    float low;
    float middle;
    float high;
};

PT_FUNCTION Sorted sorted(float a, float b, float c)
{
    float low = less_of(a, b);
    float high = more_of(a, b);
    Sorted values;
    values.low = less_of(low, c);
    values.middle = more_of(low, less_of(high, c));
    values.high = more_of(high, c);
    return values;
}

// Median of nine values in three sorted rows: the median of the largest low, the median middle and the smallest high
// value (Paeth 1990, Median finding on a 3 x 3 grid).
PT_FUNCTION float median_of_rows(Sorted a, Sorted b, Sorted c)
{
    return sorted(more_of(more_of(a.low, b.low), c.low), sorted(a.middle, b.middle, c.middle).middle,
                  less_of(less_of(a.high, b.high), c.high))
        .middle;
}

PT_FUNCTION Sorted with_missing_above(Sorted row)
{
    row.low = row.middle;
    row.middle = row.high;
    row.high = infinity;
    return row;
}

struct Neighbourhood {
    float median; // the lower of two middle values; 0 for a pixel without neighbors
    float largest;
};

// Rows are sorted, with missing values first. The median of k present values is the fifth of nine values if 4 - (k - 1)
// / 2 missing ones count as lowest and the rest as highest. At an edge two of three missing values count as lowest, at
// a corner three of five.
PT_FUNCTION Neighbourhood neighbourhood(Sorted above, Sorted row, Sorted below, bool is_first_row, bool is_last_row,
                                        bool is_beside_edge)
{
    Neighbourhood near;
    near.largest = more_of(row.high, more_of(is_first_row ? 0.0f : above.high, is_last_row ? 0.0f : below.high));
    Sorted missing;
    missing.low = BELOW_ALL;
    missing.middle = BELOW_ALL;
    missing.high = is_beside_edge ? BELOW_ALL : infinity;
    if (is_first_row)
        above = missing;
    else if (is_beside_edge && is_last_row)
        above = with_missing_above(above);
    if (is_beside_edge && (is_first_row || is_last_row))
        row = with_missing_above(row);
    if (is_last_row)
        below = missing;
    else if (is_beside_edge)
        below = with_missing_above(below);
    near.median = median_of_rows(above, row, below);
    return near;
}

PT_FUNCTION Neighbourhood neighbourhood_in_line(Sorted line)
{
    Neighbourhood near;
    near.median = more_of(line.middle, 0.0f);
    near.largest = line.high;
    return near;
}

// Each row has one value, in `high`.
PT_FUNCTION Sorted column_of(Sorted above, Sorted row, Sorted below, bool is_first_row, bool is_last_row)
{
    return sorted(is_first_row ? BELOW_ALL : above.high, row.high, is_last_row ? BELOW_ALL : below.high);
}

#ifdef __cplusplus
} // namespace pt::gpu
#endif
#endif
