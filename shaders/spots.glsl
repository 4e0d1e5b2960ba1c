// Spots are small regions that are far brighter than their surroundings (README.md, section 7). A glow is a region of a
// plane close to a lamp. An image is a lamp's mirror image in a polished surface.
#ifndef SPOTS_GLSL
#define SPOTS_GLSL

#include "phong.glsl"
#include "lights.glsl"

struct SpotWord {
    uint lamp;
    uint surface;
    float reflectance;
    float glossiness;  // glossiness of the mirroring surface; negative: a glow
};

SpotWord spot_word(uint spot)
{
    vec4 word = scene_word_among(SPOTS, SPOT_COUNT, spot);
    uvec2 numbers = floatBitsToUint(word.xy) - MATERIAL_INDEX_BITS;
    return SpotWord(numbers.x, numbers.y, word.z, word.w);
}

uint spot_surface(uint spot) { return spot_word(spot).surface; }

vec4 plane_word(uint surface) { return scene_word_among(SPHERE_COUNT, max(PLANE_COUNT, 1u), surface - SPHERE_COUNT); }

bool is_glow(SpotWord word) { return GLOSS == 0u || word.glossiness < 0.0; }

struct Spot {
    vec4 place;   // image: unit vector, exponent of its lobe; glow: the lamp's center, squared height over the plane
    float weight; // weight in the choice of a spot; 0: the spot is not visible
};

struct Spots {
    Spot views[SPOT_LIMIT];
    float total_weight;
};

// The weight is lower if directions of the material find the spot anyway. The factor 10 is empirical.
float spot_weight(float irradiance, float found_anyway)
{
    return irradiance / (1.0 + 10.0 * found_anyway);
}

Spot view_glow(Vertex vertex, vec4 lamp, float radiance, SpotWord word)
{
    vec4 plane = plane_word(word.surface);
    float height = dot(plane.xyz, lamp.xyz) + plane.w;
    float vertex_height = abs(dot(plane.xyz, vertex.position) + plane.w);
    vec3 to_foot = lamp.xyz - height * plane.xyz - vertex.position;
    float squared_height = height * height;
    float squared_distance = dot(to_foot, to_foot) + squared_height;
    float up = max(dot(vertex.normal, to_foot) + 0.5 * abs(height), 0.0);
    float form = vertex_height * up / (squared_distance * squared_distance);
    float irradiance = 2.0 * word.reflectance * radiance * lamp.w * lamp.w * form;
    bool seen = word.surface != vertex.surface && squared_height > lamp.w * lamp.w;
    return Spot(vec4(lamp.xyz, squared_height), seen ? spot_weight(irradiance, squared_height * form) : 0.0);
}

struct MirrorPoint {
    vec3 position;
    vec3 normal;
    float curvature;
    bool exists;
};

MirrorPoint mirror_point_of_plane(Vertex vertex, vec4 lamp, uint surface)
{
    vec4 plane = plane_word(surface);
    float lamp_height = dot(plane.xyz, lamp.xyz) + plane.w;
    float height = dot(plane.xyz, vertex.position) + plane.w;
    vec3 foot = vertex.position - height * plane.xyz;
    vec3 lamp_foot = lamp.xyz - lamp_height * plane.xyz;
    vec3 position = foot + (height / (height + lamp_height)) * (lamp_foot - foot);
    return MirrorPoint(position, height > 0.0 ? plane.xyz : -plane.xyz, 0.0, height * lamp_height > 0.0);
}

// Alhazen's problem: find the normal that bisects the angle between the directions to the vertex and to the lamp. The
// first normal of the iteration is exact in two limits: vertex and lamp far from the sphere (bisector), or both close
// to it (ratio of heights). The iteration's error raises the variance but causes no bias.
MirrorPoint mirror_point_of_sphere(Vertex vertex, vec4 lamp, uint surface, float time)
{
    vec4 sphere = ball_of(surface, time).center_radius;
    vec3 a = vertex.position - sphere.xyz;
    vec3 b = lamp.xyz - sphere.xyz;
    float radius = sphere.w;
    float a_length = length(a);
    float b_length = length(b);
    float a_height = max(a_length - radius, 0.0);
    float b_height = max(b_length - radius, 0.0);
    vec3 towards_a = a * (b_height / ((radius + b_height) * a_length));
    vec3 towards_b = b * (a_height / ((radius + a_height) * b_length));
    vec3 normal = normalize(towards_a + towards_b);
    uint step = 0u;
    [[unroll]] do {
        vec3 position = radius * normal;
        normal = normalize(normalize(a - position) + normalize(b - position));
        ++step;
    } while (step < 2u);
    bool exists = a_length > radius && b_length > radius + lamp.w;
    return MirrorPoint(sphere.xyz + radius * normal, normal, 1.0 / radius, exists);
}

// In narrower lobes the rounding of directions would be visible.
const float LARGEST_SPOT_EXPONENT = 1e6;

Spot view_image(Vertex vertex, vec4 lamp, float radiance, SpotWord word, float time)
{
    MirrorPoint mirror;
    if (is_sphere(word.surface))
        mirror = mirror_point_of_sphere(vertex, lamp, word.surface, time);
    else
        mirror = mirror_point_of_plane(vertex, lamp, word.surface);
    vec3 to_mirror = mirror.position - vertex.position;
    vec3 to_lamp = lamp.xyz - mirror.position;
    float distance = length(to_mirror);
    float squared_beyond = dot(to_lamp, to_lamp);
    vec3 direction = to_mirror / distance;
    float cosine = dot(vertex.normal, direction);
    float mirror_cosine = -dot(mirror.normal, direction);

    float turn = 1.0 + distance * (inversesqrt(squared_beyond) + 2.0 * mirror.curvature);
    float squared_sine = lamp.w * lamp.w / squared_beyond;
    float exponent = turn * turn / (1.0 / max(word.glossiness, 1.0) + 0.25 * squared_sine);
    float irradiance = word.reflectance * mirror_cosine * radiance * squared_sine * cosine / (turn * turn);
    bool faces = distance > 0.0 && cosine > 0.0 && mirror_cosine > 0.0;
    bool seen = mirror.exists && faces && word.surface != vertex.surface;
    float weight = seen ? spot_weight(irradiance, 2.0 * cosine / exponent) : 0.0;
    return Spot(vec4(direction, min(exponent, LARGEST_SPOT_EXPONENT)), weight);
}

Spots spots_from(Vertex vertex, float time)
{
    Spots spots;
    spots.total_weight = 0.0;
    uint i = 0u;
    [[unroll]] do {
        SpotWord word = spot_word(i);
        vec4 lamp = bound_of_lamp(word.lamp, time);
        float radiance = emission_of_lamp(word.lamp).a;
        if (is_glow(word))
            spots.views[i] = view_glow(vertex, lamp, radiance, word);
        else
            spots.views[i] = view_image(vertex, lamp, radiance, word, time);
        spots.total_weight += spots.views[i].weight;
        ++i;
    } while (i < SPOT_COUNT);
    return spots;
}

// Returns the last spot of positive weight for which the sum over earlier spots is at most number * total_weight.
uint choose_spot(Spots spots, float number)
{
    float target = number * spots.total_weight;
    float cumulated = 0.0;
    uint chosen = 0u;
    uint i = 0u;
    [[unroll]] do {
        float weight = spots.views[i].weight;
        chosen = cumulated <= target && weight > 0.0 ? i : chosen;
        cumulated += weight;
        ++i;
    } while (i < SPOT_COUNT);
    return chosen;
}

// An image is sampled by a lobe about its direction. A glow is sampled at the point where a ray of cosine density from
// the lamp hits the plane.
vec3 direction_to_spot(Spots spots, uint spot, vec3 position, float time, vec2 place)
{
    SpotWord word = spot_word(spot);
    vec4 at = spots.views[0].place;
    uint i = 1u;
    [[unroll]] while (i < SPOT_COUNT) {
        at = spot == i ? spots.views[i].place : at;
        ++i;
    }
    vec3 axis = at.xyz;
    vec2 cos_sin = cosine_hemisphere_cos_sin(place.x);
    if (GLOSS == 1u)
        cos_sin = is_glow(word) ? cos_sin : lobe_cos_sin(at.w, place.x);
    if (PLANE_COUNT > 0u && is_glow(word)) {
        vec4 plane = plane_word(word.surface);
        axis = dot(plane.xyz, at.xyz) + plane.w > 0.0 ? -plane.xyz : plane.xyz;
    }
    vec3 direction = direction_about(axis, cos_sin, place.y);
    if (is_glow(word))
        direction = normalize(at.xyz + sqrt(at.w) / max(cos_sin.x, NUMBER_STEP) * direction - position);
    return direction;
}

// Density of direction_to_spot() over solid angle. Only spots of the surface that the ray hit contribute.
float spot_density(Spots spots, Arrival arrival, float distance, float time)
{
    float density = 0.0;
    uint i = 0u;
    [[unroll]] do {
        SpotWord word = spot_word(i);
        vec4 at = spots.views[i].place;
        float of_spot;
        if (is_glow(word)) {
            vec4 plane = plane_word(word.surface);
            vec3 from_lamp = arrival.point - at.xyz;
            float ratio = distance / dot(from_lamp, from_lamp);
            of_spot = at.w * ratio * ratio / (PI * max(abs(dot(plane.xyz, arrival.direction)), NUMBER_STEP));
        } else {
            of_spot = (at.w + 1.0) / (2.0 * PI) * lobe_power(at.xyz, arrival.direction, at.w);
        }
        density += word.surface == arrival.surface ? spots.views[i].weight * of_spot : 0.0;
        ++i;
    } while (i < SPOT_COUNT);
    return spots.total_weight > 0.0 ? density / spots.total_weight : 0.0;
}

#endif
