// Rays against spheres and planes, without epsilons: a ray carries the surface that it leaves. Used by path.glsl.
#ifndef INTERSECT_GLSL
#define INTERSECT_GLSL

#include "scene.glsl"

// Finite, as Vulkan does not promise infinities; farther than anything that a scene may hold.
const float NO_HIT = 3.0e38;

// How a ray starts: on which surface, if any, and there on the inside of a sphere or not.
struct Start {
    vec3 origin;
    uint surface; // NO_SURFACE for rays from the camera
    bool inside;
};

// Distance along the unit vector direction to a sphere, or NO_HIT. to_centre = centre - origin; leaving: the ray
// starts on it. With b = to_centre . direction and l the part of to_centre across the ray, the roots are b -+
// sqrt(r^2 - l^2). Taking l by subtraction of vectors, not of squares, keeps small far spheres in place (Haines et
// al., "Precision Improvements for Ray/Sphere Intersection", Ray Tracing Gems 2019, chapter 7). From a point of the
// sphere itself the roots are 0 and 2 b: from outside the ray never meets it again, from inside at 2 b. The side is
// known: for small far spheres and grazing directions the sign of b would tell it wrongly.
float sphere_distance(vec3 to_centre, float radius, vec3 direction, bool leaving, bool inside)
{
    float b = dot(to_centre, direction);
    vec3 across = to_centre - b * direction;
    float squared_half_chord = radius * radius - dot(across, across);
    float half_chord = sqrt(max(squared_half_chord, 0.0));
    bool outside = dot(to_centre, to_centre) > radius * radius;
    float distance = outside ? b - half_chord : b + half_chord;
    bool met = squared_half_chord >= 0.0 || !outside; // no direction leads out of a sphere but through its surface
    distance = leaving ? abs(2.0 * b) : distance;
    met = leaving ? inside : met;
    return met && distance > 0.0 ? distance : NO_HIT;
}

// Distance along direction to a plane, or NO_HIT. height = normal . origin + offset; leaving: the ray starts on it.
float plane_distance(float height, vec3 normal, vec3 direction, bool leaving)
{
    float distance = -height / dot(normal, direction);
    return !leaving && distance > 0.0 ? distance : NO_HIT;
}

struct Hit {
    float distance; // NO_HIT if there is none
    uint surface;   // NO_SURFACE if there is none
};

void keep_closer(inout Hit hit, float distance, uint surface)
{
    bool closer = distance < hit.distance;
    hit.distance = closer ? distance : hit.distance;
    hit.surface = closer ? surface : hit.surface;
}

// First surface that a ray from the camera, at the origin, meets.
Hit closest_hit(vec3 direction, float time)
{
    Hit hit = Hit(NO_HIT, NO_SURFACE);
    if (SPHERE_COUNT > 0u) {
        uint i = 0u;
        [[unroll]] do {
            vec4 sphere = sphere_at(i, time);
            keep_closer(hit, sphere_distance(sphere.xyz, sphere.w, direction, false, false), i);
            ++i;
        } while (i < SPHERE_COUNT);
    }
    if (PLANE_COUNT > 0u) {
        uint i = SPHERE_COUNT;
        [[unroll]] do {
            vec4 plane = geometry_of(i);
            keep_closer(hit, plane_distance(plane.w, plane.xyz, direction, false), i);
            ++i;
        } while (i < SURFACE_COUNT);
    }
    return hit;
}

// A ray towards a lamp: it is blocked by what it meets before the lamp.
struct ShadowRay {
    vec3 direction;
    float distance; // to the lamp; 0 where there is no lamp to look for
    uint lamp;      // never blocks itself
};

// Whether a shadow ray is blocked.
bool is_blocked(Start start, float time, ShadowRay shadow)
{
    bool blocked = false;
    if (SPHERE_COUNT > 0u) {
        uint i = 0u;
        [[unroll]] do {
            vec4 sphere = sphere_at(i, time);
            vec3 to_centre = sphere.xyz - start.origin;
            bool leaving = i == start.surface;
            float distance = sphere_distance(to_centre, sphere.w, shadow.direction, leaving, start.inside);
            blocked = blocked || (distance < shadow.distance && i != shadow.lamp);
            ++i;
        } while (i < SPHERE_COUNT);
    }
    if (PLANE_COUNT > 0u) {
        uint i = SPHERE_COUNT;
        [[unroll]] do {
            vec4 plane = geometry_of(i);
            float height = dot(plane.xyz, start.origin) + plane.w;
            float distance = plane_distance(height, plane.xyz, shadow.direction, i == start.surface);
            blocked = blocked || distance < shadow.distance;
            ++i;
        } while (i < SURFACE_COUNT);
    }
    return blocked;
}

// One walk over the scene for the two rays that leave a vertex: what the next path ray meets first, and whether the
// shadow ray is blocked. Each surface is fetched once for both.
Hit closest_hit_and_shadow(Start start, float time, vec3 direction, ShadowRay shadow, out bool blocked)
{
    Hit hit = Hit(NO_HIT, NO_SURFACE);
    blocked = false;
    if (SPHERE_COUNT > 0u) {
        uint i = 0u;
        [[unroll]] do {
            vec4 sphere = sphere_at(i, time);
            vec3 to_centre = sphere.xyz - start.origin;
            bool leaving = i == start.surface;
            keep_closer(hit, sphere_distance(to_centre, sphere.w, direction, leaving, start.inside), i);
            float distance = sphere_distance(to_centre, sphere.w, shadow.direction, leaving, start.inside);
            blocked = blocked || (distance < shadow.distance && i != shadow.lamp);
            ++i;
        } while (i < SPHERE_COUNT);
    }
    if (PLANE_COUNT > 0u) {
        uint i = SPHERE_COUNT;
        [[unroll]] do {
            vec4 plane = geometry_of(i);
            float height = dot(plane.xyz, start.origin) + plane.w;
            bool leaving = i == start.surface;
            keep_closer(hit, plane_distance(height, plane.xyz, direction, leaving), i);
            float distance = plane_distance(height, plane.xyz, shadow.direction, leaving);
            blocked = blocked || distance < shadow.distance;
            ++i;
        } while (i < SURFACE_COUNT);
    }
    return hit;
}

#endif
