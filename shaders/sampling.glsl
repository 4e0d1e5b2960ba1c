// Directions from random numbers (shaders/README.md, section 5).
#ifndef SAMPLING_GLSL
#define SAMPLING_GLSL

#include "maths.glsl"

// Angles about the z axis. The polar angle is stored as cosine and sine, because Vulkan allows acos an error of 4096
// ulp.
struct SphericalAngles {
    float cos_polar;
    float sin_polar;
    float azimuth; // turns, [0, 1)
};

// Density 1 / (4 pi) on the sphere. sqrt(1 - cos^2) would suffer from cancellation at the poles.
SphericalAngles uniform_spherical_angles(vec2 u)
{
    return SphericalAngles(1.0 - 2.0 * u.x, 2.0 * sqrt(u.x * (1.0 - u.x)), u.y);
}

vec3 spherical_direction(SphericalAngles angles)
{
    float sine, cosine;
    sin_cos_turn(angles.azimuth, sine, cosine);
    return vec3(angles.sin_polar * cosine, angles.sin_polar * sine, angles.cos_polar);
}

vec3 uniform_hemisphere_direction(vec3 axis, vec2 u)
{
    vec3 direction = spherical_direction(uniform_spherical_angles(u));
    return dot(direction, axis) < 0.0 ? -direction : direction;
}

// A uniform point of the unit disc (Shirley and Chiu 1997).
vec2 concentric_disc(vec2 u)
{
    vec2 place = 2.0 * u - 1.0;
    vec2 size = abs(place);
    bool along_x = size.x > size.y;
    float radius = along_x ? size.x : size.y;
    float ratio = radius > 0.0 ? (along_x ? size.y : size.x) / radius : 0.0;
    float sine, cosine;
    sin_cos_turn(0.125 * ratio, sine, cosine);
    return radius * sign(place) * (along_x ? vec2(cosine, sine) : vec2(sine, cosine));
}

// Rotates v by the rotation that takes the z axis to the unit vector `axis` (Duff et al. 2017).
vec3 rotate_to_axis(vec3 axis, vec3 v)
{
    float s = axis.z < 0.0 ? -1.0 : 1.0;
    float q = axis.x * (s * v.x) + axis.y * v.y;
    float along = v.z - q / (s + axis.z);
    return vec3(v.x + axis.x * along, s * v.y + axis.y * along, v.z * axis.z - q);
}

vec3 direction_about(vec3 axis, vec2 cos_sin_polar, float azimuth)
{
    return rotate_to_axis(axis, spherical_direction(SphericalAngles(cos_sin_polar.x, cos_sin_polar.y, azimuth)));
}

// Samples the polar angle with density cos(theta) / pi (Malley). Returns its cosine and sine. sqrt(1 - x^2 - y^2) would
// suffer from cancellation near the horizon.
vec2 cosine_hemisphere_cos_sin(float u)
{
    return vec2(sqrt(1.0 - u), sqrt(u));
}

// Cosine and sine from h = 1 - cos. sqrt(h (2 - h)) is precise in narrow cones.
vec2 narrow_cos_sin(float one_minus_cos)
{
    return vec2(1.0 - one_minus_cos, sqrt(one_minus_cos * (2.0 - one_minus_cos)));
}

// Weight of density a > 0 against b >= 0, with exponent 2 (Veach 1997, chapter 9). If b / a overflows, the weight is 0.
float power_heuristic(float a, float b)
{
    float ratio = b / a;
    return 1.0 / (1.0 + ratio * ratio);
}

float power_heuristic_over_density(float a, float b)
{
    float inverse = 1.0 / a;
    float ratio = b * inverse;
    return inverse / (1.0 + ratio * ratio);
}

#endif
