// The point of a surface that a path has reached. Used by phong.glsl, lights.glsl and path.glsl.
#ifndef VERTEX_GLSL
#define VERTEX_GLSL

#include "scene.glsl"

// A point of a surface that a path has reached.
struct Vertex {
    vec3 position;
    vec3 normal;   // unit, on the side that the path came from
    vec3 incoming; // unit direction in which the path arrived
    uint surface;
    bool inside; // of the sphere that the surface is; of a plane, on the side away from its normal
};

// The vertex at a distance along a ray, where it meets a surface. The point is moved onto its surface: along the ray
// it is off by the rounding of the distance, up to thousands of times more than by that of the point itself.
Vertex vertex_at(vec3 origin, vec3 direction, float distance, uint surface, float time)
{
    vec3 position = origin + distance * direction;
    vec3 normal;
    if (surface < SPHERE_COUNT) {
        vec4 sphere = sphere_among(SPHERE_COUNT, surface, time);
        normal = normalize(position - sphere.xyz);
        position = sphere.xyz + sphere.w * normal;
    } else {
        Level level = level_among(surface, position);
        normal = CURVATURE == 1 ? normalize(level.gradient) : level.gradient;
        position -= level.height * normal;
    }
    bool inside = dot(normal, direction) > 0.0;
    return Vertex(position, inside ? -normal : normal, direction, surface, inside);
}

#endif
