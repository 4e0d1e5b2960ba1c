// A surface that is held by a ball, and rays against it: a ball that may move, or a capsule, which does not move, but is a
// ball swept along a segment. All that tells these kinds apart is here. The kinds that a surface may be of, a bit each, are
// KINDS, or TREE_KINDS in the tree. Part of scene.glsl.
#ifndef BALL_GLSL
#define BALL_GLSL

#include "maths.glsl"

// Finite, because Vulkan does not promise infinities, and farther than anything in a scene.
const float NO_HIT = 3.0e38;

// A ball at a time, or the first end of a capsule and its axis: the way from one end to the other, and 1 / its length.
struct Ball {
    vec4 centre_radius;
    vec4 axis;
};

const vec4 NO_AXIS = vec4(0.0);

const bool HAS_WAYS = MOTION == 1u || KINDS > KIND_BALL;

// From the words that gpu_layout.h describes. The place is that at time 0 of those in which the way is counted.
Ball ball_from(vec4 centre_radius, vec4 way, float time, uint kinds)
{
    bool is_capsule = (kinds & KIND_CAPSULE) != 0u && way.w > 0.0;
    if (MOTION == 1)
        centre_radius.xyz += is_capsule ? vec3(0.0) : time * way.xyz;
    return Ball(centre_radius, is_capsule ? way : NO_AXIS);
}

// Of the swept balls' centres the one that is nearest to a place. centre: the first one; to_first: the way there from the
// place.
vec3 nearest_centre(Ball ball, vec3 centre, vec3 to_first, uint kinds)
{
    if ((kinds & KIND_CAPSULE) == 0u)
        return centre;
    vec4 axis = ball.axis;
    return centre + clamp(-dot(to_first, axis.xyz * axis.w) * axis.w, 0.0, 1.0) * axis.xyz;
}

// Distance along the unit vector direction to a sphere that no path gets inside of, or NO_HIT: see sphere_distance.
float distance_from_outside(vec3 to_centre, float radius, vec3 direction, bool leaving)
{
    float b = dot(to_centre, direction);
    vec3 across = to_centre - b * direction;
    float squared_half_chord = radius * radius - dot(across, across);
    float nearer = b - sqrt(squared_half_chord); // any value if there is no root
    return !leaving && squared_half_chord >= 0.0 && b > 0.0 ? nearer : NO_HIT;
}

// Distance along the unit vector direction to a sphere, or NO_HIT. to_centre = centre - origin; leaving: the ray
// starts on it. With b = to_centre . direction and l the part of to_centre across the ray, the roots are b -+
// sqrt(r^2 - l^2). Taking l by subtraction of vectors, not of squares, keeps small far spheres in place (Haines et
// al., "Precision Improvements for Ray/Sphere Intersection", Ray Tracing Gems 2019, chapter 7). From a point of the
// sphere itself the roots are 0 and 2 b: from outside the ray never meets it again, from inside at 2 b. The vertex
// knows its side; for small far spheres and grazing directions the sign of b would tell it wrongly. The side and the
// direction tell whether there is a hit: from outside, a line that meets the sphere does so ahead if it leads inwards,
// b > 0; from inside, every direction meets it. The sign of the distance does not tell, because rounding may turn it
// for rays that start near the sphere. If the camera is outside all spheres, no path ever gets inside. outside: whether
// a ray that starts elsewhere is outside of this sphere.
float sphere_distance(vec3 to_centre, float radius, vec3 direction, bool leaving, bool inside, bool outside)
{
    if (INSIDE == 0)
        return distance_from_outside(to_centre, radius, direction, leaving);
    float b = dot(to_centre, direction);
    vec3 across = to_centre - b * direction;
    float squared_half_chord = radius * radius - dot(across, across);
    float half_chord = sqrt(at_least(squared_half_chord, 0.0));
    float distance = outside ? b - half_chord : b + half_chord;
    bool met = !outside || (squared_half_chord >= 0.0 && b > 0.0);
    distance = leaving ? abs(2.0 * b) : distance;
    met = leaving ? inside : met;
    return met ? distance : NO_HIT;
}

// Whether the sphere blocks a shadow ray that comes from outside all spheres and ends at a distance: whether the nearer
// root b - sqrt(r^2 - l^2) is less than that, without taking the root. at_end: the ray starts or ends on it.
bool sphere_blocks(vec3 to_centre, float radius, vec3 direction, bool at_end, float distance)
{
    float b = dot(to_centre, direction);
    vec3 across = to_centre - b * direction;
    float beyond = at_least(b - distance, 0.0);
    bool met_before = dot(across, across) + beyond * beyond < radius * radius;
    return !at_end && b > 0.0 && met_before;
}

// A capsule is a ball swept from one end of a segment to the other. A ray meets it where it meets the first of the swept
// balls, and leaves it where it leaves the last. This function finds these balls; then all that is said above of distances
// to a ball holds.
//
// With the unit vector u of the axis, its length L, c = u . direction, the part p of u across the ray and the part l of
// the way to the first end, the ball at s on the axis is met at b + s c - sqrt(r^2 - |l + s p|^2). This is least where
// its derivative is 0: at s = (n - c h) / |p|, with n = -l . p / |p| and the half chord h of the nearest approach,
// h^2 = r^2 - |l + n p / |p||^2 (p . p + c c = 1 has been used). With the other sign of h the ball is the last that the
// ray leaves. Both are convex in s, so on the segment it is the value clamped to [0, L]. Along the axis |p| = 0, and the
// sign of c h tells the end.
//
// Rounding of u, p and the ball's place acts like a shift of the ends by d = 2^-22 (|to_first| + L) at most, across the
// ray. A ball that is off by e = d / |p| along the axis is met later by e^2 / (2 h |p|), of second order; but where
// |p|^2 < 2 d / h, nearly along the axis, it might not be met at all. With h - d for h it is met wherever the ray meets
// the endless cylinder, and later by d / |p| at most, which is no more than a shift by d changes the distance.
//
// Returns the way from the first end to the middle of that ball.
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

// The way from a ray's origin to the centre of the ball that it meets first, or of the one that it leaves last.
vec3 to_met(Ball ball, vec3 to_first, vec3 direction, bool to_last, uint kinds)
{
    if ((kinds & KIND_CAPSULE) == 0u)
        return to_first;
    return to_first + swept_to(to_first, ball.axis, ball.centre_radius.w, direction, to_last);
}

// sphere_distance() for a ball whose centre_radius is to_first from the ray's origin, and from_side from where its side is
// told. From outside, the first ball of a capsule is met; from inside, the last one. A ray that leaves the capsule's
// surface towards its inside usually starts on another ball than it meets.
float ball_distance(Ball ball, vec3 to_first, vec3 from_side, vec3 direction, bool leaving, bool inside, uint kinds)
{
    vec3 to_centre = nearest_centre(ball, from_side, from_side, kinds);
    float radius = ball.centre_radius.w;
    bool outside = dot(to_centre, to_centre) > radius * radius;
    if ((kinds & KIND_CAPSULE) == 0u)
        return sphere_distance(to_first, radius, direction, leaving, inside, outside);
    bool to_last = INSIDE == 1 && (leaving ? inside : !outside);
    bool leaving_ball = leaving && !(to_last && ball.axis.w > 0.0);
    return sphere_distance(to_met(ball, to_first, direction, to_last, kinds), radius, direction, leaving_ball, inside,
                           !to_last);
}

// sphere_blocks() likewise.
bool ball_blocks(Ball ball, vec3 to_first, vec3 direction, bool at_end, float distance, uint kinds)
{
    vec3 to_centre = to_met(ball, to_first, direction, false, kinds);
    return sphere_blocks(to_centre, ball.centre_radius.w, direction, at_end, distance);
}

#endif
