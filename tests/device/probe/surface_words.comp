// Reads with the shipped functions what the scene says of each surface, at half time and for a point.
#version 450
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_control_flow_attributes : require

#include "scene.glsl"

layout(local_size_x = WORKGROUP_SIZE) in;
layout(push_constant) uniform Push { vec4 point; };

struct Read {
    vec4 emission; // 0 for what may not emit
    vec4 lamp_emission; // 0 for what is no lamp
    vec4 diffuse;
    vec4 specular;
    vec4 sphere; // 0 for a plane, as the next
    vec4 sphere_among;
    vec4 gradient_height; // 0 for a sphere, as the next
    vec4 gradient_height_among;
    vec4 curvatures;
};
layout(set = 0, binding = 2) writeonly buffer Output { Read reads[]; };

// The index is a loop's, as scene_word asks for.
void read(uint surface)
{
    Read result;
    result.emission = may_emit(surface) ? emission_of(surface) : vec4(0.0);
    result.lamp_emission = surface < LAMP_COUNT ? emission_of_lamp(surface) : vec4(0.0);
    result.diffuse = diffuse_of(surface);
    result.specular = specular_of(surface);
    result.sphere = result.sphere_among = vec4(0.0);
    result.gradient_height = result.gradient_height_among = result.curvatures = vec4(0.0);
    if (surface < SPHERE_COUNT) {
        result.sphere = sphere_at(surface, 0.5);
        result.sphere_among = sphere_among(SPHERE_COUNT, surface, 0.5);
    } else {
        Level level = level_at(surface, point.xyz, 0.0);
        Level among = level_among(surface, point.xyz, 0.0);
        result.gradient_height = vec4(level.gradient, level.height);
        result.gradient_height_among = vec4(among.gradient, among.height);
        result.curvatures = vec4(level.curvature, among.curvature, 0.0, 0.0);
    }
    reads[surface] = result;
}

void main()
{
    if (gl_GlobalInvocationID.x != 0u)
        return;
    FOR_EACH(surface, 0u, SURFACE_COUNT, read(surface))
}
