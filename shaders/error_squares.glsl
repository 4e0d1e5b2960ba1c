// Sums of squares that are expected of errors, with the squares of the pixels' shares in them: shares are numbers that
// their squares leave in the range of float32.
#ifndef ERROR_SQUARES_GLSL
#define ERROR_SQUARES_GLSL

#include "pixel_error.h"

struct Squares {
    float sum;
    float shares;
};

// Of a sum that is not 0. What is all of it has a share of 1, though a division may be off by some units in the last
// place: one tile alone has no spread, which the host finds as a difference of shares.
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

// Of both the pixels.
Squares united(Squares a, Squares b)
{
    float sum = a.sum + b.sum;
    return Squares(sum, sum > 0.0 ? squared(share_of(a.sum, sum)) * a.shares + squared(share_of(b.sum, sum)) * b.shares
                                  : 0.0);
}

#endif
