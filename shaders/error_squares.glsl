// Sums of expected squares of errors, with the squares of the shares that pixels have in them. Unlike squares of the
// summands, squares of shares stay within the range of float32.
#ifndef ERROR_SQUARES_GLSL
#define ERROR_SQUARES_GLSL

#include "pixel_error.h"

struct Squares {
    float sum;
    float shares;
};

// The share in a sum that is not 0. A part that is the whole sum has a share of exactly 1, although a division may be
// off by some units in the last place: a single tile has no spread, and the host computes the spread as a difference of
// shares.
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

// Of the pixels of both.
Squares united(Squares a, Squares b)
{
    float sum = a.sum + b.sum;
    return Squares(sum, sum > 0.0 ? squared(share_of(a.sum, sum)) * a.shares + squared(share_of(b.sum, sum)) * b.shares
                                  : 0.0);
}

#endif
