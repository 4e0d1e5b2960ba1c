// Rays against spheres and planes, without epsilons: a ray carries the surface that it leaves. Used by path.glsl.
#ifndef INTERSECT_GLSL
#define INTERSECT_GLSL

#include "scene.glsl"

const float NO_HIT = 1.0 / 0.0;

// Distance along the unit vector direction to a sphere, or NO_HIT. to_centre = centre - origin; leaving: the origin is on it.
// With b = to_centre . direction and l the part of to_centre across the ray, the roots are b -+ sqrt(r^2 - l^2). Taking l by
// subtraction of vectors, not of squares, keeps small far spheres in place (Haines et al., "Precision Improvements for
// Ray/Sphere Intersection", Ray Tracing Gems 2019, chapter 7). From a point of the sphere itself the roots are 0 and 2 b:
// a ray that goes outwards (b < 0) never meets it again.
float sphere_distance(vec3 to_centre, float radius, vec3 direction, bool leaving)
{
    float b = dot(to_centre, direction);
    vec3 across = to_centre - b * direction;
    float squared_half_chord = radius * radius - dot(across, across);
    float half_chord = sqrt(max(squared_half_chord, 0.0));
    bool outside = dot(to_centre, to_centre) > radius * radius;
    float distance = outside ? b - half_chord : b + half_chord;
    bool met = squared_half_chord >= 0.0;
    distance = leaving ? 2.0 * b : distance;
    return (met || leaving) && distance > 0.0 ? distance : NO_HIT;
}

// Distance along direction to a plane, or NO_HIT. height = normal . origin + offset; leaving: the origin is on it.
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

// First surface that a ray from the camera meets.
Hit closest_hit(vec3 origin, vec3 direction, float time)
{
    Hit hit = Hit(NO_HIT, NO_SURFACE);
    if (SPHERE_COUNT > 0u) {
        uint i = 0u;
        [[unroll]] do {
            vec4 sphere = sphere_at(i, time);
            keep_closer(hit, sphere_distance(sphere.xyz - origin, sphere.w, direction, false), i);
            ++i;
        } while (i < SPHERE_COUNT);
    }
    if (PLANE_COUNT > 0u) {
        uint i = SPHERE_COUNT;
        [[unroll]] do {
            vec4 plane = geometry_of(i);
            keep_closer(hit, plane_distance(dot(plane.xyz, origin) + plane.w, plane.xyz, direction, false), i);
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
bool is_blocked(vec3 origin, uint leaving, float time, ShadowRay shadow)
{
    bool blocked = false;
    if (SPHERE_COUNT > 0u) {
        uint i = 0u;
        [[unroll]] do {
            vec4 sphere = sphere_at(i, time);
            float distance = sphere_distance(sphere.xyz - origin, sphere.w, shadow.direction, i == leaving);
            blocked = blocked || (distance < shadow.distance && i != shadow.lamp);
            ++i;
        } while (i < SPHERE_COUNT);
    }
    if (PLANE_COUNT > 0u) {
        uint i = SPHERE_COUNT;
        [[unroll]] do {
            vec4 plane = geometry_of(i);
            float height = dot(plane.xyz, origin) + plane.w;
            blocked = blocked || plane_distance(height, plane.xyz, shadow.direction, i == leaving) < shadow.distance;
            ++i;
        } while (i < SURFACE_COUNT);
    }
    return blocked;
}

// One walk over the scene for the two rays that leave a vertex: what the next path ray meets first, and whether the shadow
// ray is blocked. Each surface is fetched once for both.
Hit closest_hit_and_shadow(vec3 origin, uint leaving, float time, vec3 direction, ShadowRay shadow, out bool blocked)
{
    Hit hit = Hit(NO_HIT, NO_SURFACE);
    blocked = false;
    if (SPHERE_COUNT > 0u) {
        uint i = 0u;
        [[unroll]] do {
            vec4 sphere = sphere_at(i, time);
            vec3 to_centre = sphere.xyz - origin;
            keep_closer(hit, sphere_distance(to_centre, sphere.w, direction, i == leaving), i);
            float distance = sphere_distance(to_centre, sphere.w, shadow.direction, i == leaving);
            blocked = blocked || (distance < shadow.distance && i != shadow.lamp);
            ++i;
        } while (i < SPHERE_COUNT);
    }
    if (PLANE_COUNT > 0u) {
        uint i = SPHERE_COUNT;
        [[unroll]] do {
            vec4 plane = geometry_of(i);
            float height = dot(plane.xyz, origin) + plane.w;
            keep_closer(hit, plane_distance(height, plane.xyz, direction, i == leaving), i);
            float distance = plane_distance(height, plane.xyz, shadow.direction, i == leaving);
            blocked = blocked || distance < shadow.distance;
            ++i;
        } while (i < SURFACE_COUNT);
    }
    return hit;
}

#endif
