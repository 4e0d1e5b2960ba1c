// The point of a surface that a path has reached.
#ifndef VERTEX_GLSL
#define VERTEX_GLSL

#include "scene.glsl"

struct Vertex {
    vec3 position;
    vec3 normal; // unit, on the side that the path came from
    vec3 mirror; // unit direction of a mirror's reflection
    uint surface;
    bool inside; // of the sphere; for a plane, behind its normal
};

// A ray's hit.
struct Arrival {
    vec3 point;     // off the surface by the distance's rounding
    vec3 direction; // of the ray, a unit vector
    uint surface;
};

// Moves the hit onto the surface: the distance's rounding puts it off along the ray, up to thousands of times farther
// than a point's own rounding.
Vertex vertex_at(Arrival arrival, float time)
{
    uint surface = arrival.surface;
    vec3 direction = arrival.direction;
    vec3 position = arrival.point;
    vec3 normal;
    if (is_sphere(surface)) {
        Ball ball = ball_of(surface, time);
        vec3 centre = ball.centre_radius.xyz;
        centre = nearest_centre(ball, centre, centre - position, KINDS);
        vec3 from_centre = position - centre; // normalize() is three divisions on lavapipe
        normal = from_centre * inversesqrt(dot(from_centre, from_centre));
        position = centre + ball.centre_radius.w * normal;
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
