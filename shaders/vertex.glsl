#ifndef VERTEX_GLSL
#define VERTEX_GLSL

#include "scene.glsl"

struct Vertex {
    vec3 position;
    vec3 normal; // unit, on the path's side
    vec3 mirror; // unit direction of mirror reflection
    uint surface;
    bool inside; // inside the sphere, or below the plane
};

struct Arrival {
    vec3 point;     // near the surface; the distance is rounded
    vec3 direction;
    uint surface;
};

// Moves the hit onto the surface. Rounding of the distance displaces it along the ray by up to thousands of times the
// rounding of coordinates.
Vertex vertex_at(Arrival arrival, float time)
{
    uint surface = arrival.surface;
    vec3 direction = arrival.direction;
    vec3 position = arrival.point;
    vec3 normal;
    if (is_sphere(surface)) {
        Ball ball = ball_of(surface, time);
        vec3 center = ball.center_radius.xyz;
        center = nearest_center(ball, center, center - position, KINDS);
        vec3 from_center = position - center; // normalize() takes three divisions on lavapipe
        normal = from_center * inversesqrt(dot(from_center, from_center));
        position = center + ball.center_radius.w * normal;
    } else {
        Level level = level_among(surface, position, time);
        normal = CURVATURE == 1 ? normalize(level.gradient) : level.gradient;
        position -= level.height * normal;
    }
    float cosine = dot(normal, direction);
    bool inside = cosine > 0.0;
    return Vertex(position, inside ? -normal : normal, direction - 2.0 * cosine * normal, surface, inside);
}

#endif
