// Counts the samples whose camera rays hit a surface, by tracing these rays again. Each invocation has one pixel.
#version 450
#extension GL_GOOGLE_include_directive : require

#include "gpu_layout.h"

layout(local_size_x = WORKGROUP_SIZE) in;
layout(push_constant) uniform Push { CoverageConstants view; };

#include "camera_ray.glsl"
#include "camera_walk.glsl"

layout(set = 0, binding = BINDING_COVERED) buffer Covered { uint lost_rays; uint counts[]; } covered;

// The first and the last sample of each tile. Tiles without samples have last < first.
layout(set = 0, binding = BINDING_TILES) readonly buffer TileSamples { uvec2 ranges[]; } tile_samples;

uint tile_of(uvec2 pixel)
{
    uint columns = (view.camera.width + TILE_SIZE - 1u) / TILE_SIZE;
    return (pixel.y - view.first_row) / TILE_SIZE * columns + pixel.x / TILE_SIZE;
}

bool meets_something(uvec2 pixel, uint sample_index)
{
    uint pixel_index = pixel.y * view.camera.width + pixel.x;
    SampleKey key = key_of_pixel(view.seed, pixel_index);
    key.sample_index = sample_index;
    key.row = (sample_index - view.first_sample) * TABLE_BLOCKS;
    Walk walk = walk_from_camera(camera_ray(view.camera, pixel, key), opacity_number(key, 0u));
    finish(walk, false);
    return walk.hit.surface != NO_SURFACE;
}

void main()
{
    uint index = gl_GlobalInvocationID.x;
    if (index >= view.pixel_count)
        return;
    uint place = view.first_of_rectangle + index;
    uint row = place / view.rectangle_width;
    uint pixel_index = view.first_pixel + row * view.camera.width + place % view.rectangle_width;
    uvec2 pixel = uvec2(pixel_index % view.camera.width, pixel_index / view.camera.width);
    uvec2 range = tile_samples.ranges[tile_of(pixel)];
    uint current = max(range.x, view.first_sample);
    uint last = min(range.y, view.last_sample);
    if (range.y < range.x || last < current)
        return;
    uint count = 0u;
    bool done;
    do {
        count += meets_something(pixel, current) ? 1u : 0u;
        done = current == last; // before ++current, which may overflow
        ++current;
    } while (!done);
    if (TREE == 1u && walk_was_cut)
        atomicAdd(covered.lost_rays, 1u);
    covered.counts[index] += count;
}
