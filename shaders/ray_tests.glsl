// A ray against a sphere or a plane, without epsilons: a ray carries the surface that it leaves.
#ifndef RAY_TESTS_GLSL
#define RAY_TESTS_GLSL

#include "maths.glsl"
#include "scene.glsl"

// Finite, because Vulkan does not promise infinities, and farther than anything in a scene.
const float NO_HIT = 3.0e38;

// Surfaces are opaque, so a path stays on the camera's side of each of them, at the path's time. With KNOWN_SIDES the
// camera tells the side. The place of a vertex would tell it wrongly for surfaces that the vertex nearly touches:
// rounding may put the vertex behind a surface that stands just behind its own, and the path would end there, or leak
// out of a room.

// Where a ray starts: on which surface, if any, and whether inside a sphere.
struct Start {
    vec3 origin;
    uint surface; // NO_SURFACE for rays from the camera
    bool inside;
};

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

// sphere_distance() for spheres that may be swept. From outside, the first ball of the capsule is met; from inside, the last
// one. A ray that leaves the capsule's surface towards its inside usually starts on another ball than it meets.
float swept_distance(vec3 to_first, vec4 axis, float radius, vec3 direction, bool leaving, bool inside, bool outside)
{
    if (CAPSULES == 0)
        return sphere_distance(to_first, radius, direction, leaving, inside, outside);
    bool to_last = INSIDE == 1 && (leaving ? inside : !outside);
    vec3 to_centre = to_first + swept_to(to_first, axis, radius, direction, to_last);
    bool leaving_ball = leaving && !(to_last && axis.w > 0.0);
    return sphere_distance(to_centre, radius, direction, leaving_ball, inside, !to_last);
}

// The same for a ball whose first end is to_first from the ray's origin, and from_side from where its side is told.
float ball_distance(Ball ball, vec3 to_first, vec3 from_side, vec3 direction, bool leaving, bool inside)
{
    vec3 to_centre = CAPSULES == 1 ? from_side + to_nearest(from_side, ball.axis) : from_side;
    float radius = ball.centre_radius.w;
    bool outside = dot(to_centre, to_centre) > radius * radius;
    return swept_distance(to_first, ball.axis, radius, direction, leaving, inside, outside);
}

// Distance along the unit vector direction to a plane, or NO_HIT. level: of the plane at the ray's origin; leaving: the
// ray starts on it. With the height h, the slope s of the height along the ray and the curvature k, the roots of k / 2
// t^2 + s t + h = 0 are 2 |h| / q and q / k up to their signs, with q = |s| + sqrt(s^2 - 2 k h), in which nothing
// cancels. The first, a plane's only one, is ahead if the ray leads towards the surface. The second is the far wall,
// for rays that lead away from the surface on the inside, h < 0. From a point of the surface itself h = 0. Far above
// the surface s^2 - 2 k h would cancel; 1 - l^2, with l the part of the gradient across the ray, does not and is the
// same, since the squared length of the gradient is 1 + 2 k h. side: the height of the camera above a flat plane. If it
// tells the side, a ray that leads towards the surface meets it, at a negative distance if rounding has put the ray's
// origin behind it.
float plane_distance(Level level, vec3 direction, bool leaving, bool inside, float side)
{
    float slope = dot(level.gradient, direction);
    if (CURVATURE == 0) {
        float distance = -level.height / slope;
        bool towards = KNOWN_SIDES == 1 ? slope < 0.0 : distance > 0.0;
        return !leaving && towards ? distance : NO_HIT;
    }
    float height = leaving ? 0.0 : level.height;
    bool below = leaving ? inside : height < 0.0 || (height == 0.0 && slope < 0.0);
    if (KNOWN_SIDES == 1) {
        below = side < 0.0;
        height = below ? min(height, 0.0) : max(height, 0.0);
    }
    float rise = 2.0 * level.curvature * height;
    vec3 across = level.gradient - slope * direction;
    float discriminant = rise > 1.0 ? 1.0 - dot(across, across) : slope * slope - rise;
    float q = abs(slope) + sqrt(at_least(discriminant, 0.0));
    bool near = !leaving && discriminant >= 0.0 && below == (slope > 0.0);
    bool far = !near && below && level.curvature > 0.0;
    float distance = (far ? q : 2.0 * abs(height)) / (far ? level.curvature : q);
    return (near || far) && (distance > 0.0 || KNOWN_SIDES == 1) ? distance : NO_HIT;
}

struct Hit {
    float distance; // NO_HIT if there is none; negative if rounding has put the ray's start beyond the surface
    uint surface;   // NO_SURFACE if there is none
};

void keep_closer(inout Hit hit, float distance, uint surface)
{
    bool closer = distance < hit.distance;
    hit.distance = closer ? distance : hit.distance;
    hit.surface = closer ? surface : hit.surface;
}

// A ray towards a lamp: anything that it meets before the lamp blocks it.
struct ShadowRay {
    vec3 direction;
    float distance; // to the lamp; 0 where there is no lamp to look for
    uint lamp;      // its surface, which never blocks itself
};

const ShadowRay NO_SHADOW_RAY = ShadowRay(vec3(0.0), 0.0, NO_SURFACE);

// The tests that all walks share. A walk fetches a surface once for all its rays, so these take what was fetched.
float distance_to_sphere(Start start, vec3 direction, uint sphere, Ball ball)
{
    vec3 to_first = ball.centre_radius.xyz - start.origin;
    vec3 from_side = KNOWN_SIDES == 1 ? ball.centre_radius.xyz : to_first;
    return ball_distance(ball, to_first, from_side, direction, sphere == start.surface, start.inside);
}

// A lamp is no capsule.
float distance_to_lamp(Start start, vec3 direction, uint surface, vec4 centre_radius)
{
    return distance_to_sphere(start, direction, surface, Ball(centre_radius, NO_AXIS));
}

float distance_to_plane(Start start, vec3 direction, uint plane, Level level, float time)
{
    return plane_distance(level, direction, plane == start.surface, start.inside, camera_height(plane, time));
}

// Whether a surface at some distance along a shadow ray blocks it. At equal distances the first surface is the one that
// is seen.
bool blocks(ShadowRay shadow, float distance, uint surface)
{
    bool before = distance < shadow.distance || (CLOSE_LAMPS == 1 && distance == shadow.distance && surface < shadow.lamp);
    return before && surface != shadow.lamp;
}

void shade_sphere(inout bool blocked, Start start, ShadowRay shadow, uint sphere, Ball ball)
{
    if (INSIDE == 1 || CLOSE_LAMPS == 1) {
        float distance = distance_to_sphere(start, shadow.direction, sphere, ball);
        blocked = blocked || blocks(shadow, distance, sphere);
        return;
    }
    bool at_end = sphere == start.surface || (sphere < WALKED_LAMPS && sphere == shadow.lamp);
    vec3 to_centre = ball.centre_radius.xyz - start.origin;
    if (CAPSULES == 1)
        to_centre += swept_to(to_centre, ball.axis, ball.centre_radius.w, shadow.direction, false);
    bool between = sphere_blocks(to_centre, ball.centre_radius.w, shadow.direction, at_end, shadow.distance);
    blocked = blocked || between;
}

void shade_plane(inout bool blocked, Start start, ShadowRay shadow, uint plane, Level level, float time)
{
    blocked = blocked || blocks(shadow, distance_to_plane(start, shadow.direction, plane, level, time), plane);
}

// If a lamp nearly coincides with another sphere, a ray towards it ends where an intersection finds the lamp. Then the
// distances to both come from one formula, so just one of them is less, however they are rounded, and light that both
// send is counted once. If the ray misses the lamp by rounding, it ends where the lamp was sampled.
ShadowRay ended_as_met(ShadowRay shadow, Start start, float time)
{
    if (CLOSE_LAMPS == 1 && shadow.distance > 0.0 && is_walked_lamp(shadow.lamp)) {
        vec4 lamp = sphere_among(WALKED_LAMPS, shadow.lamp, time);
        float distance = distance_to_lamp(start, shadow.direction, shadow.lamp, lamp);
        shadow.distance = distance < NO_HIT ? distance : shadow.distance;
    }
    return shadow;
}

#endif
