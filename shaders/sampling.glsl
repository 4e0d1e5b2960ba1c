// Directions from random numbers, each with its density over solid angle.
#ifndef SAMPLING_GLSL
#define SAMPLING_GLSL

#include "maths.glsl"

// A direction as polar angle from the z axis and azimuth about it. The polar angle is held by its cosine and sine:
// Vulkan allows acos an error of 4096 ulp, and nothing here needs the angle itself.
struct SphericalAngles {
    float cos_polar;
    float sin_polar;
    float azimuth; // in turns, [0, 1)
};

// Two random numbers to the spherical angles of a direction uniform on the sphere, density 1 / (4 pi).
// Archimedes: the cosine of the polar angle, 1 - 2 u, is uniform. Its sine is taken as 2 sqrt(u (1 - u)), since
// sqrt(1 - cos^2) cancels at the poles.
SphericalAngles uniform_spherical_angles(vec2 u)
{
    return SphericalAngles(1.0 - 2.0 * u.x, 2.0 * sqrt(u.x * (1.0 - u.x)), u.y);
}

// The unit vector with these spherical angles.
vec3 spherical_direction(SphericalAngles angles)
{
    float sine, cosine;
    sin_cos_turn(angles.azimuth, sine, cosine);
    return vec3(angles.sin_polar * cosine, angles.sin_polar * sine, angles.cos_polar);
}

// Direction uniform on the hemisphere about the unit vector axis, density 1 / (2 pi): that of the sphere, mirrored up.
vec3 uniform_hemisphere_direction(vec3 axis, vec2 u)
{
    vec3 direction = spherical_direction(uniform_spherical_angles(u));
    return dot(direction, axis) < 0.0 ? -direction : direction;
}

// Uniform point of the unit disc: squares about the middle of the unit square become circles (Shirley and Chiu, "A Low
// Distortion Map Between Disk and Square", Journal of Graphics Tools 2(3), 1997), so that neighbours stay neighbours, and
// what is even in the square is so on the disc. Of the two coordinates the larger is the radius, and their ratio tells the
// angle from the nearer axis, an eighth of a turn at most.
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

// Turns a vector given about the z axis to be about the unit vector axis. The basis is that of Duff et al., "Building
// an Orthonormal Basis, Revisited" (JCGT 6(1), 2017), which is accurate for every axis, -z included: with s the sign of
// z and a = -1 / (s + z), the vectors (1 + s a x^2, s a x y, -s x), (a x y, s + a y^2, -y) and (x, y, z). Their sum is
// not taken vector by vector, since q = s x v_x + y v_y occurs in each of its components.
vec3 rotate_to_axis(vec3 axis, vec3 v)
{
    float s = axis.z < 0.0 ? -1.0 : 1.0;
    float q = axis.x * (s * v.x) + axis.y * v.y;
    float along = v.z - q / (s + axis.z);
    return vec3(v.x + axis.x * along, s * v.y + axis.y * along, v.z * axis.z - q);
}

// The direction at a polar angle from axis, given by its cosine and sine, and an azimuth in turns.
vec3 direction_about(vec3 axis, vec2 cos_sin_polar, float azimuth)
{
    return rotate_to_axis(axis, spherical_direction(SphericalAngles(cos_sin_polar.x, cos_sin_polar.y, azimuth)));
}

// Polar angle of a direction with density cos(theta) / pi on a hemisphere: a uniform point of the disc, lifted to the
// sphere (Malley). The height is sqrt(1 - u), not sqrt(1 - x^2 - y^2), which cancels near the horizon.
vec2 cosine_hemisphere_cos_sin(float u)
{
    return vec2(sqrt(1.0 - u), sqrt(u));
}

// Polar angle in a cone, given the distance one_minus_cos of its cosine from 1. With h = 1 - cos,
// sin = sqrt(h (2 - h)) has no cancellation however narrow the cone.
vec2 narrow_cos_sin(float one_minus_cos)
{
    return vec2(1.0 - one_minus_cos, sqrt(one_minus_cos * (2.0 - one_minus_cos)));
}

// Weight of a sample of density a in the power heuristic with exponent 2 against a technique of density b (Veach 1997,
// chapter 9), a > 0, b >= 0. Through the ratio, so that no square overflows unless the weight is 0.
float power_heuristic(float a, float b)
{
    float ratio = b / a;
    return 1.0 / (1.0 + ratio * ratio);
}

// The same divided by a, which is what a sample's value is multiplied by. It saves a division.
float power_heuristic_over_density(float a, float b)
{
    float inverse = 1.0 / a;
    float ratio = b * inverse;
    return inverse / (1.0 + ratio * ratio);
}

#endif
