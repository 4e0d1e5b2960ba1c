// Expected squared errors of a pixel in one channel (shaders/README.md, section 11). Values are radiance on the host
// and film units in kernels.
#ifndef PT_PIXEL_ERROR_H
#define PT_PIXEL_ERROR_H

#include "dialects.h"

#ifdef __cplusplus
namespace pt::gpu {
#endif

PT_FUNCTION real squared(real value)
{
    return value * value;
}

struct ValueSet {
    real sum;
    real count;
    real largest;
    real second;
};

PT_FUNCTION ValueSet empty_set()
{
    ValueSet values;
    values.sum = 0.0;
    values.count = 0.0;
    values.largest = 0.0;
    values.second = 0.0;
    return values;
}

PT_FUNCTION ValueSet with_value(ValueSet values, real value)
{
    values.sum += value;
    values.count += 1.0;
    values.second = more_of(values.second, less_of(value, values.largest));
    values.largest = more_of(values.largest, value);
    return values;
}

PT_FUNCTION ValueSet united(ValueSet a, ValueSet b)
{
    a.sum += b.sum;
    a.count += b.count;
    a.second = more_of(more_of(a.second, b.second), less_of(a.largest, b.largest));
    a.largest = more_of(a.largest, b.largest);
    return a;
}

// Leaves out the largest of the other values, which may be a firefly.
PT_FUNCTION real mean_besides_and_without_largest(ValueSet values, real value)
{
    real largest_of_others = value < values.largest ? values.largest : values.second;
    return more_of(values.sum - value - largest_of_others, 0.0) / more_of(values.count - 2.0, 1.0);
}

// Brightness around a pixel, from the median of its neighbors and from its tile. If a neighbor is brighter than the
// pixel, the result is at least an eighth of it, like the mean of the pixel's eight neighbors.
PT_FUNCTION real around(real mean, ValueSet tile, real median_beside, real largest_beside)
{
    real of_brighter = largest_beside > mean ? 0.125 * largest_beside : 0.0;
    return more_of(more_of(median_beside, of_brighter), mean_besides_and_without_largest(tile, mean));
}

// The estimated limit of a pixel. Relative squared errors are divided by its square (shaders/README.md, section 11).
//
// At an edge the surroundings are bright, but at least half of the samples are dark. Let a sample have the value M with
// probability p, otherwise 0, and let exactly one of N samples have the value M. Then the mean is T = M / N, the
// squared error is about T^2, and the limit is M p. If p is uniformly distributed a priori, y = N p has the density y
// e^-y. With k^2 = Limit.known, the expectation of T^2 / (M^2 p^2 + k^2) is the integral of y e^-y / (y^2 + k^2 / T^2).
// This is about ln(T / k) - 1. The 1 depends on the prior and is left out, because the result then fits the calibration
// scenes.
struct Limit {
    real square;       // limit^2 + offset^2
    real known;        // (mean of the darker part)^2 + offset^2
    real light_beyond; // > 0 at an edge
    real alone;        // > 0 if the pixel stands out from its surroundings
};

PT_CONSTANT real E_SQUARED = 7.39; // e^2. A pixel stands out if square / known exceeds this number.

// If the darker part has the fraction f of the samples, standard_error / (mean - lesser) = sqrt(f / (1 - f)). For f =
// 1/2 this is 1, up to rounding.
PT_CONSTANT real OF_HALVES = 0.99;

// offset_square keeps the relative errors of black pixels finite.
PT_FUNCTION Limit limit_of(real standard_error, real mean, real lesser, real around, real offset_square)
{
    Limit limit;
    limit.square = less_of(squared(mean), squared(more_of(lesser, around))) + offset_square;
    limit.known = squared(lesser) + offset_square;
    real most_are_dark = standard_error >= OF_HALVES * (mean - lesser) ? 1.0 : 0.0;
    real bright_around = around >= mean ? 1.0 : 0.0;
    limit.light_beyond = most_are_dark * bright_around * (limit.square - E_SQUARED * limit.known);
    limit.alone = squared(mean) + offset_square - E_SQUARED * (squared(around) + offset_square);
    return limit;
}

PT_FUNCTION real relative_square(real standard_error, Limit limit)
{
    real square = square_of_quotient(standard_error, limit.square);
    return limit.light_beyond > 0.0 ? square * (0.5 * log(limit.square / limit.known)) : square;
}

PT_FUNCTION real square_as_lamp(real standard_error, real mean, real offset_square)
{
    return square_of_quotient(standard_error, squared(mean) + offset_square);
}

// A pixel that stands out shows a lamp or highlight, or one rare bright sample. lib/film/error_estimate.cpp compares
// how many of these pixels were met once (only one part has samples that hit the light) and how many were met again
// (both parts have).
PT_FUNCTION bool is_met_once(real standard_error, real mean, real lesser)
{
    return lesser <= 0.02 * mean && standard_error >= OF_HALVES * (mean - lesser);
}

PT_FUNCTION bool is_met_again(real mean, real lesser)
{
    return lesser >= 0.25 * mean;
}

// The light M of a neighbor may fill a fraction p of this pixel that none of N samples hit, if the pixel's mean T is
// below M / N. An edge that cuts off a corner of height x cuts off an area proportional to x^2. So p is below q with
// the probability c sqrt(q). Let a^2 = (T^2 + offset_square) / M^2 and b = 1 / (N a). The squared error p M^2 / N has
// the relative expectation
//
// integral from 0 to 1 / N of c / (2 sqrt(p)) p / N / (a^2 + p^2) dp = c sqrt(b / N) G(sqrt(b)).
//
// G(t) is the integral of u^2 / (1 + u^4) from 0 to t. The approximation t^3 / (3 + 0.81 t^2 + 0.9 t^3) is too small by
// at most a seventh. c = 0.055 is calibrated (shaders/README.md, section 11).
PT_FUNCTION real unseen_square(real mean, real largest_beside, real sample_count, real offset_square)
{
    real brightest = largest_beside / sample_count;
    if (mean >= brightest)
        return 0.0;
    real b = brightest / sqrt(squared(mean) + offset_square);
    return 0.055 * squared(b) / (sqrt(sample_count) * (3.0 + 0.81 * b + 0.9 * b * sqrt(b)));
}

#ifdef __cplusplus
} // namespace pt::gpu
#endif
#endif
