// What is expected of the error of a pixel's value, from what it and its neighbours show: the formulas of
// lib/film/error_region.cpp, which has their derivations, in float32. Values are in film units.
#ifndef PIXEL_ERROR_GLSL
#define PIXEL_ERROR_GLSL

float squared(float value)
{
    return value * value;
}

// Values of which one asks for the mean of the others.
struct ValueSet {
    float sum;
    float count;
    float largest;
    float second;
};

ValueSet empty_set()
{
    return ValueSet(0.0, 0.0, 0.0, 0.0);
}

ValueSet with_value(ValueSet values, float value)
{
    return ValueSet(values.sum + value, values.count + 1.0, max(values.largest, value),
                    max(values.second, min(value, values.largest)));
}

ValueSet united(ValueSet a, ValueSet b)
{
    return ValueSet(a.sum + b.sum, a.count + b.count, max(a.largest, b.largest),
                    max(max(a.second, b.second), min(a.largest, b.largest)));
}

float mean_besides(ValueSet values, float value)
{
    return max(values.sum - value, 0.0) / max(values.count - 1.0, 1.0);
}

// The largest of the others may be a firefly too.
float mean_besides_and_without_largest(ValueSet values, float value)
{
    float largest_of_others = value < values.largest ? values.largest : values.second;
    return max(values.sum - value - largest_of_others, 0.0) / max(values.count - 2.0, 1.0);
}

// The mean about a pixel, of its tile or, where one pixel of that has most of the light, of its region.
float level_about(float mean, ValueSet tile, ValueSet region)
{
    float level = mean_besides_and_without_largest(tile, mean);
    return level >= 0.5 * mean_besides(tile, mean) ? level : mean_besides_and_without_largest(region, mean);
}

// Three values in ascending order.
vec3 sorted(float a, float b, float c)
{
    float low = min(a, b);
    float high = max(a, b);
    return vec3(min(low, c), max(low, min(high, c)), max(high, c));
}

struct Neighbourhood {
    float median;
    float largest;
};

// Of nine values in three sorted rows (Paeth 1990, Median finding on a 3 x 3 grid).
float median_of_rows(vec3 a, vec3 b, vec3 c)
{
    return sorted(sorted(a.x, b.x, c.x).z, sorted(a.y, b.y, c.y).y, sorted(a.z, b.z, c.z).x).y;
}

// What divides the square of a value's error, and what is added to a square: offset^2.
struct RelativeError {
    float offset; // in film units
    float scale;  // of the root of the square, so that a square is a finite float
};

const float e_squared = 7.39; // where the logarithm of an edge passes 1, and a pixel begins to stand out

bool stands_out(float mean, float around, RelativeError relative)
{
    float offset = squared(relative.offset);
    return squared(mean) + offset > e_squared * (squared(around) + offset);
}

bool is_met_once(float standard_error, float mean, float lesser)
{
    return lesser <= 0.02 * mean && standard_error >= 0.99 * (mean - lesser);
}

bool is_met_again(float mean, float lesser)
{
    return lesser >= 0.25 * mean;
}

// The square of the error relative to the value's own mean, times scale^2.
float square_as_lamp(float standard_error, float mean, RelativeError relative)
{
    return squared(standard_error * relative.scale * inversesqrt(squared(mean) + squared(relative.offset)));
}

// The square of the error relative to the value's limit, as far as the samples tell, times scale^2.
float relative_square(float standard_error, float mean, float lesser, float around, RelativeError relative)
{
    if (standard_error == 0.0)
        return 0.0;
    float limit = squared(min(mean, max(lesser, around))) + squared(relative.offset);
    float known = squared(lesser) + squared(relative.offset);
    bool most_are_dark = standard_error >= 0.99 * (mean - lesser);
    bool at_edge = most_are_dark && around >= mean && limit > e_squared * known;
    return squared(standard_error * relative.scale * inversesqrt(limit)) * (at_edge ? 0.5 * log(limit / known) : 1.0);
}

// The same of light beside the pixel that may be in it too, but that none of its samples met; not scaled.
float unseen_square(float mean, float largest_beside, float sample_count, float offset)
{
    float brightest = largest_beside / sample_count;
    if (mean >= brightest)
        return 0.0;
    float ratio = squared(brightest) / (squared(mean) + squared(offset));
    // Where 1 + ratio would lose its digits, the first terms of the series do.
    float logarithm = ratio < 0.015625 ? ratio * (1.0 - ratio * (0.5 - ratio * (1.0 / 3.0))) : log(1.0 + ratio);
    return 0.5 / sample_count * logarithm;
}

#endif
