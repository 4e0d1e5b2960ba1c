// Draws directions with the shipped sampling functions: one per invocation.
#version 450
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_control_flow_attributes : require

#include "phong.glsl"
#include "sampler.glsl"

layout(local_size_x = WORKGROUP_SIZE) in;
layout(push_constant) uniform Push { vec4 axis; uint kind; float glossiness; uint seed; uint count; };
layout(set = 0, binding = 2) writeonly buffer Output { vec4 directions[]; };

const uint UNIFORM_SPHERE = 0u;
const uint UNIFORM_HEMISPHERE = 1u;
const uint COSINE_HEMISPHERE = 2u;

void main()
{
    uint index = gl_GlobalInvocationID.x;
    if (index >= count)
        return;
    vec2 u = sample_block(key_of_pixel(uvec2(seed, 7u), index), 0u).xy;
    vec3 direction;
    if (kind == UNIFORM_SPHERE)
        direction = spherical_direction(uniform_spherical_angles(u));
    else if (kind == UNIFORM_HEMISPHERE)
        direction = uniform_hemisphere_direction(axis.xyz, u);
    else if (kind == COSINE_HEMISPHERE)
        direction = direction_about(axis.xyz, cosine_hemisphere_cos_sin(u.x), u.y);
    else
        direction = direction_about(axis.xyz, lobe_cos_sin(glossiness, u.x), u.y);
    directions[index] = vec4(direction, 0.0);
}
