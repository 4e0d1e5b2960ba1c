#version 450
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_control_flow_attributes : require

#include "sampler.glsl"
#include "spots.glsl"

layout(local_size_x = WORKGROUP_SIZE) in;
layout(push_constant) uniform Push { vec4 position; vec4 normal; uint surface; uint seed; uint count; };

struct Drawn {
    vec4 direction_density; // w: density per solid angle, over all spots of the surface
    uint surface;
    float distance;
    uint reserved[2];
};
layout(set = 0, binding = 2) writeonly buffer Output { Drawn drawn[]; };

void main()
{
    uint index = gl_GlobalInvocationID.x;
    if (index >= count)
        return;
    Vertex vertex = Vertex(position.xyz, normal.xyz, normal.xyz, surface, false);
    Spots spots = spots_from(vertex, 0.0);
    uvec4 words = sample_words(key_of_pixel(uvec2(seed, 11u), index), 0u);
    vec3 numbers = vec3(words.xyz >> 8u) * NUMBER_STEP;
    uint spot = choose_spot(spots, numbers.z);
    vec3 direction = direction_to_spot(spots, spot, vertex.position, 0.0, numbers.xy);
    Start start = Start(vertex.position, vertex.surface, vertex.inside);
    bool blocked;
    Hit hit = closest_hit_and_shadow(start, 0.0, direction, NO_SHADOW_RAY, blocked);
    bool met = hit.surface == spot_surface(spot);
    Arrival arrival = Arrival(vertex.position + hit.distance * direction, direction, spot_surface(spot));
    float density = met ? spot_density(spots, arrival, hit.distance, 0.0) : 0.0;
    drawn[index] = Drawn(vec4(direction, density), spot_surface(spot), met ? hit.distance : 0.0, uint[](0u, 0u));
}
