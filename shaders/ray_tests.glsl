// Intersects rays with surfaces, without epsilons (shaders/README.md, section 3).
#ifndef RAY_TESTS_GLSL
#define RAY_TESTS_GLSL

#include "maths.glsl"
#include "scene.glsl"
#include "tree.glsl"

// With KNOWN_SIDES paths stay on the camera's side of each surface. Otherwise rounding may put a vertex on the wrong
// side of a close surface. The path then ends or passes through the surface.

struct Start {
    vec3 origin;
    uint surface; // NO_SURFACE for camera rays
    bool inside;
};

// Distance along a unit vector to a plane, or NO_HIT: 2 |h| / q or q / k of shaders/README.md, section 3. `level`
// belongs to the ray's origin, `side` is the camera's height above the plane. With KNOWN_SIDES a ray towards the plane
// always hits it; the distance is negative if rounding has put the origin behind the plane.
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
    float distance; // or NO_HIT; negative if rounding has put the start beyond the surface
    uint surface;
};

void keep_closer(inout Hit hit, float distance, uint surface)
{
    bool closer = distance < hit.distance;
    hit.distance = closer ? distance : hit.distance;
    hit.surface = closer ? surface : hit.surface;
}

struct ShadowRay {
    vec3 direction;
    float distance; // 0: no shadow ray
    uint lamp;      // the lamp's surface, which never blocks the ray
};

const ShadowRay NO_SHADOW_RAY = ShadowRay(vec3(0.0), 0.0, NO_SURFACE);

// Largest distance of a ray's start from another surface that coincides with its own. Rounding moves a vertex by at
// most 2^-22 of its distance. Coincident tree spheres are moved apart by up to 16 grid steps
// (lib/tree/coincident_spheres.h).
float rounding_of(Start start)
{
    return 2.3841858e-7 * dot(abs(start.origin), vec3(1.0)) + (TREE_OPACITY == 1 ? 16.0 * tree_step() : 0.0);
}

float distance_to_sphere(Start start, vec3 direction, uint sphere, Ball ball)
{
    vec3 to_first = ball.center_radius.xyz - start.origin;
    vec3 from_side = KNOWN_SIDES == 1 ? ball.center_radius.xyz : to_first;
    return ball_distance(ball, to_first, from_side, direction, sphere == start.surface, start.inside, rounding_of(start),
                         KINDS);
}

float distance_to_plane(Start start, vec3 direction, uint plane, Level level, float time)
{
    return plane_distance(level, direction, plane == start.surface, start.inside, camera_height(plane, time));
}

// At equal distances the surface with the lower index is visible.
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
    vec3 to_first = ball.center_radius.xyz - start.origin;
    bool between = ball_blocks(ball, to_first, shadow.direction, at_end, shadow.distance, KINDS);
    blocked = blocked || between;
}

void shade_plane(inout bool blocked, Start start, ShadowRay shadow, uint plane, Level level, float time)
{
    blocked = blocked || blocks(shadow, distance_to_plane(start, shadow.direction, plane, level, time), plane);
}

// If a lamp nearly coincides with another sphere, the shadow ray to it ends where an intersection test finds the lamp.
// One formula then gives the distances to both spheres, so their order is always the same, and light that both emit
// counts once. If the test misses the lamp by rounding, the ray ends at the sampled point.
ShadowRay ended_as_met(ShadowRay shadow, Start start, float time)
{
    if (CLOSE_LAMPS == 1 && shadow.distance > 0.0 && is_walked_lamp(shadow.lamp)) {
        Ball lamp = ball_among(WALKED_LAMPS, shadow.lamp, time);
        float distance = distance_to_sphere(start, shadow.direction, shadow.lamp, lamp);
        shadow.distance = distance < NO_HIT ? distance : shadow.distance;
    }
    return shadow;
}

#endif
