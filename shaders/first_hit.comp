// First hits of camera rays. Depth and object have no meaningful mean, so they come from the ray through the pixel's
// center at the middle of the exposure. Normal and albedo are means over pixel and shutter, because denoisers need
// edges as smooth as the image's.
#version 450
#extension GL_GOOGLE_include_directive : require

#include "gpu_layout.h"

layout(local_size_x = WORKGROUP_SIZE) in;
layout(push_constant) uniform Push { FirstHitConstants view; };

#include "camera_walk.glsl"
#include "maths.glsl"
#include "resolved.glsl"

const uint FLOAT_INFINITY_BITS = 0x7f800000u;

shared vec3 values[WORKGROUP_SIZE];

// Returns the place in the pixel (x, y) and the time (z), from the rank-1 lattice (Korobov 1959) with the largest
// distance between points.
vec3 lattice_point(uint ray)
{
    uvec3 point = uvec3(ray, 3u * ray, 5u * ray) % FILTER_RAYS;
    return (vec3(point) + 0.5) / float(FILTER_RAYS);
}

// Like opacity_number() of dimensions.glsl, but with one lattice for all pixels, so the bits that choose the lattice
// are 0. Multiples of the golden ratio (0x9e3779b9 / 2^32) spread the numbers over neighboring pixels.
uint opacity_number(uint pixel_index, uint ray)
{
    return ((pixel_index + 1u) * 0x9e3779b9u + bitfieldReverse(ray)) & ~TREE_OPACITY_BITS;
}

float depth_of(CameraRay ray, Hit hit)
{
    float cosine = dot(ray.direction, view.camera.forward) / length(view.camera.forward);
    return view.start_distance + max(hit.distance, 0.0) * cosine;
}

vec3 albedo_of(uint surface)
{
    vec4 specular = specular_of(surface);
    return min(diffuse_of(surface).rgb * PI + specular.rgb * (2.0 * PI / (specular.a + 2.0)), vec3(1.0));
}

vec3 value_of(CameraRay ray, Hit hit)
{
    if (view.quantity == QUANTITY_DEPTH)
        return vec3(depth_of(ray, hit));
    if (view.quantity == QUANTITY_ALBEDO)
        return albedo_of(hit.surface);
    return vertex_at(arrival_of(ray, hit), ray.time).normal;
}

void main()
{
    const uint ray_count = rays_of_pixel(view.quantity);
    const bool takes_mean = ray_count > 1u;
    const uint index = gl_GlobalInvocationID.x / ray_count;
    const uint ray_index = gl_GlobalInvocationID.x % ray_count;
    const bool is_there = index < view.pixel_count;

    vec3 value = vec3(0.0);
    uint surface = NO_SURFACE;
    if (is_there) {
        uint row = (view.first_of_rectangle + index) / view.rectangle_width;
        uint column = (view.first_of_rectangle + index) % view.rectangle_width;
        uint pixel_index = view.first_pixel + row * view.camera.width + column;
        uvec2 pixel = uvec2(pixel_index % view.camera.width, pixel_index / view.camera.width);
        CameraRay ray = ray_through(view.camera, pixel, takes_mean ? lattice_point(ray_index) : vec3(0.5));
        Walk walk = walk_from_camera(ray, opacity_number(pixel_index, ray_index));
        finish(walk, false);
        surface = walk.hit.surface;
        if (TREE == 1u && walk_was_cut)
            atomicAdd(findings.lost_pixels, 1u);
        if (surface != NO_SURFACE)
            value = value_of(ray, walk.hit);
    }
    values[gl_LocalInvocationIndex] = value;
    barrier();
    if (!is_there || ray_index != 0u)
        return;

    if (takes_mean) {
        for (uint i = 1u; i < FILTER_RAYS; ++i)
            value += values[gl_LocalInvocationIndex + i];
        value /= float(FILTER_RAYS);
    }
    uvec3 words = floatBitsToUint(value);
    if (view.quantity == QUANTITY_DEPTH && surface == NO_SURFACE)
        words = uvec3(FLOAT_INFINITY_BITS);
    if (view.quantity == QUANTITY_OBJECT)
        words = uvec3(surface);
    write_pixel(words_of_pixel(view.format) * index, view.format, words);
}
