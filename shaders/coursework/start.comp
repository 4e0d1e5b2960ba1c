// The first kernel of the coursework, in place of pathtrace.comp; shaders/COURSEWORK.md has the steps. It shows the
// shape of the surface that a pixel's ray meets, without any light. The library's code provides surfaces, camera and
// exact sums; everything else stands here, as plain as it can be.
#version 450
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_control_flow_attributes : require

#include "gpu_layout.h"

layout(local_size_x = WORKGROUP_SIZE) in;
layout(push_constant) uniform Push { FrameConstants frame; };

#include "camera.glsl"
#include "film.glsl"
#include "maths.glsl"
#include "scene.glsl"
#include "tile_pixel.glsl"
#include "trace.glsl"

// ---- Numbers ------------------------------------------------------------------------------------------------------

uint pixel_index;
uint sample_index;
uint dimension; // how many numbers the sample has used

// The hash pcg of Jarzynski and Olano, "Hash Functions for GPU Rendering" (JCGT 9(3), 2020), of one word.
uint hash(uint word)
{
    uint state = word * 747796405u + 2891336453u;
    uint mixed = ((state >> ((state >> 28u) + 4u)) ^ state) * 277803737u;
    return (mixed >> 22u) ^ mixed;
}

// A word as a multiple of 2^-24 in [0, 1).
float unit_number(uint word) { return float(word >> 8u) / 16777216.0; }

// The sample's next random number in [0, 1). A sample has the same numbers on every device.
float next_number()
{
    ++dimension;
    uint word = hash(dimension + hash(sample_index + hash(pixel_index + hash(frame.seed.x))));
    return traced_number(unit_number(word));
}

// ---- Surfaces -----------------------------------------------------------------------------------------------------

const float NEAR = 0.001; // nearer hits do not count: a ray must not hit the surface that it leaves
const float FAR = 1.0e9;

struct Ray {
    vec3 origin;
    vec3 direction; // a unit vector
};

struct Hit {
    float distance; // FAR: nothing was met
    vec3 position;
    vec3 normal; // a unit vector, on the side from which the ray came
    uint surface;
};

struct Material {
    vec3 diffuse;
    vec3 specular;
    float glossiness;
};

// The scene buffer has diffuse / pi and specular (n + 2) / (2 pi). This returns the colors without these factors.
Material material_of(uint surface)
{
    vec4 specular = specular_of(surface);
    return Material(PI * diffuse_of(surface).rgb, specular.rgb * (2.0 * PI / (specular.a + 2.0)), specular.a);
}

// Where a ray meets a sphere (center, radius): |origin + distance direction - center|^2 = radius^2.
float distance_to_sphere(Ray ray, vec4 sphere)
{
    vec3 to_center = sphere.xyz - ray.origin;
    float along = dot(to_center, ray.direction);
    float across = dot(to_center, to_center) - along * along;
    float half_chord = sqrt(max(sphere.w * sphere.w - across, 0.0));
    float first = along - half_chord;
    float distance = first > NEAR ? first : along + half_chord;
    return across < sphere.w * sphere.w && distance > NEAR ? distance : FAR;
}

// Where a ray meets a plane (normal, offset): dot(normal, origin + distance direction) + offset = 0.
float distance_to_plane(Ray ray, vec4 plane)
{
    float distance = -(dot(plane.xyz, ray.origin) + plane.w) / dot(plane.xyz, ray.direction);
    return distance > NEAR ? distance : FAR;
}

// The nearest surface on a ray.
Hit nearest(Ray ray)
{
    Hit hit = Hit(FAR, vec3(0.0), vec3(0.0), 0u);
    [[unroll]] for (uint i = 0u; i < SPHERE_COUNT; ++i) {
        vec4 sphere = ball_at(i, 0.0).center_radius;
        float distance = distance_to_sphere(ray, sphere);
        if (distance < hit.distance) {
            vec3 position = ray.origin + distance * ray.direction;
            hit = Hit(distance, position, normalize(position - sphere.xyz), i);
        }
    }
    [[unroll]] for (uint i = SPHERE_COUNT; i < SURFACE_COUNT; ++i) {
        vec4 plane = scene_word(i);
        float distance = distance_to_plane(ray, plane);
        if (distance < hit.distance)
            hit = Hit(distance, ray.origin + distance * ray.direction, plane.xyz, i);
    }
    hit.normal = faceforward(hit.normal, ray.direction, hit.normal);
    return hit;
}

// ---- Light --------------------------------------------------------------------------------------------------------

// Radiance of a sample of the pixel: red, green and blue.
vec3 sample_of(uvec2 pixel)
{
    vec2 from_middle = image_place(frame.camera, pixel, vec2(0.5)); // through the middle of the pixel
    vec3 direction = camera_direction(frame.camera, from_middle);
    vec3 origin = camera_origin(frame.camera, from_middle) - 2.0 * NEAR * direction; // the ray may start on a surface
    Ray ray = Ray(origin, direction);
    Hit hit = nearest(ray);
    if (hit.distance == FAR)
        return vec3(0.0);
    trace_vertex(1u, hit.position, vec3(1.0)); // for `pt view`
    return vec3(dot(hit.normal, -ray.direction));
}

// ---- Samples of a pixel -------------------------------------------------------------------------------------------

void main()
{
    TilePixel at = tile_pixel();
    if (!at.exists)
        return;
    pixel_index = at.in_image;
    uvec2 pixel = uvec2(at.in_image % frame.camera.width, at.in_image / frame.camera.width);

    FilmPixel gathered = empty_film_pixel();
    uint first = gl_GlobalInvocationID.y * frame.share;
    for (uint i = first; i < min(first + frame.share, frame.sample_count); ++i) {
        sample_index = frame.first_sample + i;
        dimension = 0u;
        film_add(gathered, traced_sample(sample_of(pixel) * frame.film_scale));
    }
    film_store(frame.film_part, at.in_strip, frame.strip_pixel_count, gathered, OVERLAP == 1u, frame.is_first == 1u);
}
