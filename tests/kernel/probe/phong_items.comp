#version 450
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_control_flow_attributes : require

#include "phong.glsl"

#include "items.glsl"

struct Item { vec4 axis_glossiness; vec4 outgoing_diffuse; vec4 normal_specular; vec4 numbers_probability; };
struct Result { vec4 direction; vec4 power_value_density; };
layout(set = 0, binding = 2) writeonly buffer Output { Result results[]; };
layout(set = 0, binding = 3) readonly buffer Input { Item items[]; };

void main()
{
    uint index = gl_GlobalInvocationID.x;
    if (!is_item(index))
        return;
    Item item = items[index];
    vec3 axis = item.axis_glossiness.xyz;
    float n = item.axis_glossiness.w;
    vec3 outgoing = item.outgoing_diffuse.xyz;
    vec3 specular = vec3(item.normal_specular.w * (n + 2.0) / (2.0 * PI));
    Material material = Material(vec3(item.outgoing_diffuse.w / PI), specular, n, item.numbers_probability.z);
    vec3 normal = item.normal_specular.xyz;
    Vertex vertex = Vertex(vec3(0.0), normal, reflect(axis, normal), 0u, false);
    Reflection found = reflection(material, vertex, outgoing);
    results[index] = Result(vec4(direction_about(axis, lobe_cos_sin(n, item.numbers_probability.x), item.numbers_probability.y), 0.0),
                            vec4(lobe_power(axis, outgoing, n), found.f.r * found.cosine, found.density, 0.0));
}
