#version 450
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_control_flow_attributes : require

#include "lights.glsl"
#include "sampler.glsl"

layout(local_size_x = WORKGROUP_SIZE) in;
layout(push_constant) uniform Push { vec4 position; vec4 normal_time; uint surface; uint seed; uint count; };

struct Drawn {
    vec4 direction_distance;
    uint lamp;
    float density;     // density of the direction per solid angle, given the lamp
    float hit_density; // density of the direction if lamps are found by chance
    float probability;
};

layout(set = 0, binding = 2) writeonly buffer Output { Drawn drawn[]; };

void main()
{
    uint index = gl_GlobalInvocationID.x;
    if (index >= count)
        return;
    vec3 normal = normal_time.xyz;
    Vertex vertex = Vertex(position.xyz, normal, normal, surface, false);
    Lamps lamps = lamps_from(vertex, normal_time.w);
    uvec4 words = sample_words(key_of_pixel(uvec2(seed, 11u), index), 0u);
    vec2 u = vec2(words.xy >> 8u) * NUMBER_STEP;
    LampChoice choice = choose(lamps, words.z);
    if (index < LAMP_COUNT)
        choice = choice_of(lamps, index);
    LampSample taken = sample_lamp(choice, u);
    drawn[index] = Drawn(vec4(taken.shadow.direction, taken.shadow.distance), choice.lamp, taken.density,
                         cone_density(choice_of(lamps, choice.lamp).view), choice.probability);
}
