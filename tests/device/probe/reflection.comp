// Evaluates the shipped reflection() for given outgoing directions: value of the red channel and density.
#version 450
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_control_flow_attributes : require

#include "phong.glsl"

layout(local_size_x = WORKGROUP_SIZE) in;
layout(push_constant) uniform Push { vec4 incoming; float diffuse; float specular; float glossiness; float probability; uint count; };
layout(set = 0, binding = 2) writeonly buffer Output { vec4 results[]; };
layout(set = 0, binding = 3) readonly buffer Input { vec4 outgoing[]; };

void main()
{
    uint index = gl_GlobalInvocationID.x;
    if (index >= count)
        return;
    vec3 specular_word = vec3(specular * (glossiness + 2.0) / (2.0 * PI));
    Material material = Material(vec3(diffuse / PI), specular_word, glossiness, probability);
    vec3 normal = vec3(0.0, 0.0, 1.0);
    Vertex vertex = Vertex(vec3(0.0), normal, reflect(incoming.xyz, normal), 0u, false);
    Reflection result = reflection(material, vertex, outgoing[index].xyz);
    results[index] = vec4(result.f.r * result.cosine, result.density, 0.0, 0.0);
}
