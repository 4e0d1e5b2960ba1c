// What is expected of the error of a pixel's value, from what it and its neighbours show, by its mean, the standard
// error of that, and the lesser of the means of the film's two parts. On the host in radiance, in kernels in film units.
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

// A set of values >= 0, which can tell the mean of all values but one.
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

// The mean of the others without the largest of them, which may be a firefly.
PT_FUNCTION real mean_besides_and_without_largest(ValueSet values, real value)
{
    real largest_of_others = value < values.largest ? values.largest : values.second;
    return more_of(values.sum - value - largest_of_others, 0.0) / more_of(values.count - 2.0, 1.0);
}

// What is about a pixel: what most of the pixels show that touch it, and the mean of its tile; beside a brighter pixel,
// at least an eighth of that, since the mean of eight pixels cannot be less.
PT_FUNCTION real around(real mean, ValueSet tile, real median_beside, real largest_beside)
{
    real of_brighter = largest_beside > mean ? 0.125 * largest_beside : 0.0;
    return more_of(more_of(median_beside, of_brighter), mean_besides_and_without_largest(tile, mean));
}

// The square of the pixel's limit that divides the square of its error must not come from a bright sample that made
// that error, so it is no more than the squares of what is known without it: the darker part's mean, what most
// neighbours show, and the mean about it; but no more than that of the pixel's own mean either.
//
// Where that is the own mean after all, since it is bright around, but a part with half of the samples or more knows
// little of it, the pixel lies at an edge: a share p of its samples is bright, M each, and one of N was so far, hence
// the mean T = M / N and a square error of about T^2. If any p was as likely before, it is y / N with the density y
// e^-y now, and the limit is M p. The expectation of T^2 / (M^2 p^2 + k^2), with k^2 what the darker part knows and the
// offset, is the integral of y e^-y / (y^2 + k^2 / T^2): ln(T / k), less a constant of about 1 that depends on what was
// likely before; without it the stated error was right in the scenes that it was calibrated with.
struct Limit {
    real square;       // with the offset
    real known;        // square of the mean of the darker part, with the offset
    real light_beyond; // > 0: the pixel is at an edge, and the logarithm counts
    real alone;        // > 0: the pixel stands out from what is about it
};

PT_CONSTANT real E_SQUARED = 7.39; // where the logarithm of an edge passes 1, and a pixel begins to stand out

// With a share f of the samples in the darker part, standard_error / (mean - lesser) = sqrt(f / (1 - f)). For halves
// that is 1, except for the rounding of the three numbers to float.
PT_CONSTANT real OF_HALVES = 0.99;

// offset_square: added to squares so that black pixels do not count without bound.
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

// The square of the error relative to the value's limit, as far as samples tell.
PT_FUNCTION real relative_square(real standard_error, Limit limit)
{
    real square = square_of_quotient(standard_error, limit.square);
    return limit.light_beyond > 0.0 ? square * (0.5 * log(limit.square / limit.known)) : square;
}

// The same relative to the value's own mean.
PT_FUNCTION real square_as_lamp(real standard_error, real mean, real offset_square)
{
    return square_of_quotient(standard_error, squared(mean) + offset_square);
}

// A pixel that stands out is a lamp or a highlight of about its size, which many of its samples meet, or a rare bright
// sample. Nearly all of its light in one part of the film: it was met once, and nothing in the pixel tells which.
// In both parts: it was met again (lib/film/error_estimate.cpp compares how many are the one and the other).
PT_FUNCTION bool is_met_once(real standard_error, real mean, real lesser)
{
    return lesser <= 0.02 * mean && standard_error >= OF_HALVES * (mean - lesser);
}

PT_FUNCTION bool is_met_again(real mean, real lesser)
{
    return lesser >= 0.25 * mean;
}

// Light of the mean M in a pixel beside may be in a share p of this one's samples too. None of N had it if their mean
// is below M / N. What an edge at any place and angle leaves of a pixel is a corner, whose area is as the square of its
// height: a share below p is as frequent as sqrt(p), and so c sqrt(p) of these pixels have one. With the square error
// p M^2 / N and a^2 = (T^2 + offset) / M^2, the expectation of p / N / (a^2 + p^2) is the integral of c / (2 sqrt(p))
// times that from 0 to 1 / N: c sqrt(b / N) G(sqrt(b)) with b = 1 / (N a) and G(t) the integral of t^2 / (1 + t^4) from
// 0 to t. G is t^3 / 3 for small t and pi / sqrt(8) - 1 / t for large ones, and t^3 / (3 + 0.81 t^2 + 0.9 t^3), which has
// both limits, is at most a seventh less in between. c = 0.055 is calibrated (shaders/README.md, section 11).
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
