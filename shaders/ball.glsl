// Ray tests for balls and capsules. A capsule is a ball swept along a segment. The argument `kinds` has a bit for each
// kind that may occur.
#ifndef BALL_GLSL
#define BALL_GLSL

#include "maths.glsl"

// Finite, because Vulkan does not guarantee infinities.
const float NO_HIT = 3.0e38;

// A ball at one time, or the first end of a capsule. axis.xyz is the vector to the other end, axis.w is 1 / its length.
struct Ball {
    vec4 center_radius;
    vec4 axis;
};

const vec4 NO_AXIS = vec4(0.0);

const bool HAS_WAYS = MOTION == 1u || KINDS > KIND_BALL;

Ball ball_from(vec4 center_radius, vec4 way, float time, uint kinds)
{
    bool is_capsule = (kinds & KIND_CAPSULE) != 0u && way.w > 0.0;
    if (MOTION == 1)
        center_radius.xyz += is_capsule ? vec3(0.0) : time * way.xyz;
    return Ball(center_radius, is_capsule ? way : NO_AXIS);
}

// The point of a capsule's axis that is nearest to a given point. to_first is the vector from that point to the first
// end.
vec3 nearest_center(Ball ball, vec3 center, vec3 to_first, uint kinds)
{
    if ((kinds & KIND_CAPSULE) == 0u)
        return center;
    vec4 axis = ball.axis;
    return center + clamp(-dot(to_first, axis.xyz * axis.w) * axis.w, 0.0, 1.0) * axis.xyz;
}

// sphere_distance() for scenes whose paths are never inside a sphere.
float distance_from_outside(vec3 to_center, float radius, vec3 direction, bool leaving)
{
    float b = dot(to_center, direction);
    vec3 across = to_center - b * direction;
    float squared_half_chord = radius * radius - dot(across, across);
    float nearer = b - sqrt(squared_half_chord); // undefined if the ray misses
    return !leaving && squared_half_chord >= 0.0 && b > 0.0 ? nearer : NO_HIT;
}

// Distance along a unit vector to a sphere, or NO_HIT (shaders/README.md, section 3). If `leaving`, the ray starts on
// the sphere, on the side given by `inside`. Otherwise `outside` gives the side of the ray's start. Callers pass the
// side, because rounding may flip the sign of the distance.
float sphere_distance(vec3 to_center, float radius, vec3 direction, bool leaving, bool inside, bool outside)
{
    if (INSIDE == 0)
        return distance_from_outside(to_center, radius, direction, leaving);
    float b = dot(to_center, direction);
    vec3 across = to_center - b * direction;
    float squared_half_chord = radius * radius - dot(across, across);
    float half_chord = sqrt(at_least(squared_half_chord, 0.0));
    float distance = outside ? b - half_chord : b + half_chord;
    bool met = !outside || (squared_half_chord >= 0.0 && b > 0.0);
    distance = leaving ? abs(2.0 * b) : distance;
    met = leaving ? inside : met;
    return met ? distance : NO_HIT;
}

// Whether the sphere blocks a shadow ray that starts outside all spheres: b - sqrt(r^2 - l^2) < distance, without the
// root. at_end: the ray starts or ends on the sphere.
bool sphere_blocks(vec3 to_center, float radius, vec3 direction, bool at_end, float distance)
{
    float b = dot(to_center, direction);
    vec3 across = to_center - b * direction;
    float beyond = at_least(b - distance, 0.0);
    bool met_before = dot(across, across) + beyond * beyond < radius * radius;
    return !at_end && b > 0.0 && met_before;
}

// Returns the vector from a capsule's first center to the center of the ball that a ray enters first, or leaves last.
//
// The axis has the unit vector u and the length L. Let c = u . direction. Let p and l be the components of u and
// to_first perpendicular to the ray, and b the component of to_first along it. The ray enters the ball with center s u
// on the axis at the distance b + s c - sqrt(r^2 - |l + s p|^2). The minimum is at s = (n - c h) / |p|, with n = -l . p
// / |p| and h^2 = r^2 - |l + n p / |p||^2. The ray leaves the last ball at s = (n + c h) / |p|. Both distances are
// monotonic on either side of these s, so s is clamped to [0, L]. If |p| = 0, the sign of c h chooses an end.
//
// Rounding moves the ends perpendicular to the ray by d <= 2^-22 (|to_first| + L). This changes s by e = d / |p| and
// the hit distance by e^2 / (2 h |p|). If |p|^2 < 2 d / h, the ray might miss the ball, so h - d replaces h. The hit
// distance is then too large by at most d / |p|.
vec3 swept_to(vec3 to_first, vec4 axis, float radius, vec3 direction, bool to_last)
{
    vec3 unit = axis.xyz * axis.w;
    float cosine = dot(unit, direction);
    vec3 sideways = unit - cosine * direction;
    float squared_sine = dot(sideways, sideways);
    float inverse_sine = squared_sine > 0.0 ? inversesqrt(squared_sine) : 0.0;
    vec3 across = to_first - dot(to_first, direction) * direction;
    vec3 unit_sideways = sideways * inverse_sine;
    float nearest = -dot(across, unit_sideways);
    vec3 apart = across + nearest * unit_sideways;
    float rounded = 2.384185791015625e-7 * (dot(abs(to_first), vec3(1.0)) + dot(axis.xyz, unit));
    float half_chord = at_least(sqrt(at_least(radius * radius - dot(apart, apart), 0.0)) - rounded, 0.0);
    float share = (nearest - (to_last ? -cosine : cosine) * half_chord) * axis.w;
    float sine = squared_sine * inverse_sine;
    return (share >= sine ? 1.0 : share > 0.0 ? share / sine : 0.0) * axis.xyz;
}

vec3 to_met(Ball ball, vec3 to_first, vec3 direction, bool to_last, uint kinds)
{
    if ((kinds & KIND_CAPSULE) == 0u)
        return to_first;
    return to_first + swept_to(to_first, ball.axis, ball.center_radius.w, direction, to_last);
}

// Whether a ray from another surface starts outside a sphere. With TREE_OPACITY the two surfaces may coincide, for
// example at an atom and the end of its bond. If the start is within `rounding` of the sphere, the ray's direction
// decides.
bool is_outside(vec3 to_center, float radius, vec3 direction, float rounding)
{
    float squared = dot(to_center, to_center);
    if (TREE_OPACITY == 0)
        return squared > radius * radius;
    float above = squared - radius * radius;
    float nearly = 2.0 * radius * rounding;
    return above > nearly || (above > -nearly && dot(to_center, direction) < 0.0);
}

// sphere_distance() for a ball or capsule. from_side is the vector to the first center, from the point that decides on
// which side the ray is. A ray inside a capsule hits its last ball.
float ball_distance(Ball ball, vec3 to_first, vec3 from_side, vec3 direction, bool leaving, bool inside, float rounding,
                    uint kinds)
{
    vec3 to_center = nearest_center(ball, from_side, from_side, kinds);
    float radius = ball.center_radius.w;
    bool outside = is_outside(to_center, radius, direction, rounding);
    if ((kinds & KIND_CAPSULE) == 0u)
        return sphere_distance(to_first, radius, direction, leaving, inside, outside);
    bool to_last = INSIDE == 1 && (leaving ? inside : !outside);
    bool leaving_ball = leaving && !(to_last && ball.axis.w > 0.0);
    return sphere_distance(to_met(ball, to_first, direction, to_last, kinds), radius, direction, leaving_ball, inside,
                           !to_last);
}

bool ball_blocks(Ball ball, vec3 to_first, vec3 direction, bool at_end, float distance, uint kinds)
{
    vec3 to_center = to_met(ball, to_first, direction, false, kinds);
    return sphere_blocks(to_center, ball.center_radius.w, direction, at_end, distance);
}

#endif
