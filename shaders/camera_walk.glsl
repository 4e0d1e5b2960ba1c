#ifndef CAMERA_WALK_GLSL
#define CAMERA_WALK_GLSL

#include "camera.glsl"
#include "intersect.glsl"
#include "trace.glsl"
#include "tree_walk.glsl"
#include "vertex.glsl"

Walk walk_from_camera(CameraRay ray, uint opacity_number)
{
    Hit hit = closest_hit(ray.origin, ray.direction, ray.time);
    Start start = Start(ray.origin, NO_SURFACE, false);
    return walk_from(start, ray.direction, true, NO_SHADOW_RAY, ray.time, opacity_number, hit, false);
}

Arrival arrival_of(CameraRay ray, Hit hit)
{
    vec3 point = hit.distance * ray.direction;
    if (STARTS_AHEAD == 1)
        point += ray.origin;
    trace_vertex(1u, point, vec3(1.0));
    return Arrival(point, ray.direction, hit.surface);
}

#endif
