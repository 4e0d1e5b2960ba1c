#ifndef INTERSECT_GLSL
#define INTERSECT_GLSL

#include "ray_tests.glsl"

void see_sphere(inout Hit hit, vec3 origin, vec3 direction, uint sphere, float time)
{
    Ball ball = ball_at(sphere, time);
    vec3 to_center = STARTS_AHEAD == 1 ? ball.center_radius.xyz - origin : ball.center_radius.xyz;
    vec3 from_side = ball.center_radius.xyz;
    if (STARTS_ON_DISC && KNOWN_SIDES == 0)
        from_side = to_center;
    keep_closer(hit, ball_distance(ball, to_center, from_side, direction, false, false, 0.0, KINDS), sphere);
}

void see_plane(inout Hit hit, vec3 origin, vec3 direction, uint plane, float time)
{
    float height = camera_height(plane, time);
    keep_closer(hit, plane_distance(level_at(plane, origin, time), direction, false, false, height), plane);
}

// The camera does not see two ranges of spheres: [FIRST_HIDDEN, AFTER_HIDDEN), and the last HIDDEN_OTHERS.
const bool EMITTERS_HIDE = HIDDEN_LAMPS + HIDDEN_SKIES > 0u;
const uint FIRST_HIDDEN = EMITTERS_HIDE ? WALKED_LAMPS - HIDDEN_LAMPS : 0u;
const uint AFTER_HIDDEN = EMITTERS_HIDE ? WALKED_LAMPS + HIDDEN_SKIES : 0u;

Hit closest_hit(vec3 origin, vec3 direction, float time)
{
    Hit hit = Hit(NO_HIT, NO_SURFACE);
    FOR_EACH(sphere, 0u, FIRST_HIDDEN, see_sphere(hit, origin, direction, sphere, time));
    FOR_EACH(sphere, AFTER_HIDDEN, SPHERE_COUNT - HIDDEN_OTHERS, see_sphere(hit, origin, direction, sphere, time));
    FOR_EACH(plane, SPHERE_COUNT + HIDDEN_PLANES, SURFACE_COUNT, see_plane(hit, origin, direction, plane, time));
    return hit;
}

bool is_blocked(Start start, float time, ShadowRay shadow)
{
    bool blocked = false;
    FOR_EACH(sphere, 0u, SPHERE_COUNT, shade_sphere(blocked, start, shadow, sphere, ball_at(sphere, time)));
    if (PLANES_BLOCK == 1)
        FOR_EACH(plane, SPHERE_COUNT, SURFACE_COUNT,
                 shade_plane(blocked, start, shadow, plane, level_at(plane, start.origin, time), time));
    return blocked;
}

void meet_sphere(inout Hit hit, inout bool blocked, Start start, vec3 direction, ShadowRay shadow, uint sphere,
                 float time)
{
    Ball ball = ball_at(sphere, time);
    keep_closer(hit, distance_to_sphere(start, direction, sphere, ball), sphere);
    shade_sphere(blocked, start, shadow, sphere, ball);
}

void meet_plane(inout Hit hit, inout bool blocked, Start start, vec3 direction, ShadowRay shadow, uint plane,
                float time)
{
    Level level = level_at(plane, start.origin, time);
    keep_closer(hit, distance_to_plane(start, direction, plane, level, time), plane);
    if (PLANES_BLOCK == 1)
        shade_plane(blocked, start, shadow, plane, level, time);
}

Hit closest_hit_and_shadow(Start start, float time, vec3 direction, ShadowRay shadow, out bool blocked)
{
    Hit hit = Hit(NO_HIT, NO_SURFACE);
    blocked = false;
    FOR_EACH(sphere, 0u, SPHERE_COUNT, meet_sphere(hit, blocked, start, direction, shadow, sphere, time));
    FOR_EACH(plane, SPHERE_COUNT, SURFACE_COUNT, meet_plane(hit, blocked, start, direction, shadow, plane, time));
    return hit;
}

// Replaces negative distances by 0. They occur if rounding has put the start behind a plane.
Hit ahead(Hit hit)
{
    if (KNOWN_SIDES == 1 && PLANE_COUNT > 0u)
        hit.distance = at_least(hit.distance, 0.0);
    return hit;
}

#endif
