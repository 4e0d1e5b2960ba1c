#version 450
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_control_flow_attributes : require

#include "intersect.glsl"
#include "vertex.glsl"

layout(local_size_x = WORKGROUP_SIZE) in;
layout(push_constant) uniform Push { uint count; };

struct Ray {
    vec4 origin;    // w: 0 on no surface, 1 outside on surface 0, -1 inside
    vec4 direction;
};

struct Met {
    vec4 position_distance;
    vec4 normal;
    uint surface;
    uint blocked; // whether an endless shadow ray is blocked
    uint inside;
    uint unused;
};

layout(set = 0, binding = 2) writeonly buffer Output { Met met[]; };
layout(set = 0, binding = 3) readonly buffer Input { Ray rays[]; };

void main()
{
    uint index = gl_GlobalInvocationID.x;
    if (index >= count)
        return;
    Ray ray = rays[index];
    Start start = Start(ray.origin.xyz, ray.origin.w == 0.0 ? NO_SURFACE : 0u, ray.origin.w < 0.0);
    ShadowRay shadow = ShadowRay(ray.direction.xyz, NO_HIT, NO_SURFACE);
    bool blocked;
    Hit hit = closest_hit_and_shadow(start, 0.0, ray.direction.xyz, ended_as_met(shadow, start, 0.0), blocked);
    hit = ahead(hit);
    uint surface = hit.surface == NO_SURFACE ? 0u : hit.surface;
    vec3 point = start.origin + hit.distance * ray.direction.xyz;
    Vertex vertex = vertex_at(Arrival(point, ray.direction.xyz, surface), 0.0);
    met[index] = Met(vec4(vertex.position, hit.distance), vec4(vertex.normal, 0.0), hit.surface, blocked ? 1u : 0u,
                     vertex.inside ? 1u : 0u, 0u);
}
