// Each workgroup has one tile of the list.
#ifndef TILE_PIXEL_GLSL
#define TILE_PIXEL_GLSL

#include "trace.glsl"

layout(set = 0, binding = BINDING_TILES) readonly buffer Tiles { uint first_pixels[]; } tiles;

struct TilePixel {
    uint in_image;
    uint in_strip;
    bool exists; // false beyond the edges of image and strip
};

// Pixels follow Morton's curve (1966), so that invocations of one subgroup have similar tree walks. The index of a
// pixel before the strip wraps to a huge number and fails the test.
TilePixel tile_pixel()
{
    uint corner = tiles.first_pixels[frame.first_entry + gl_WorkGroupID.x];
    uint i = gl_LocalInvocationID.x;
    uint column = (i & 1u) | ((i >> 1) & 2u) | ((i >> 2) & 4u);
    uint row = ((i >> 1) & 1u) | ((i >> 2) & 2u) | ((i >> 3) & 4u);
    uint in_film = corner + row * frame.camera.width + column;
    uint in_strip = in_film - frame.strip_first_pixel;
    bool exists = corner % frame.camera.width + column < frame.camera.width && in_strip < frame.strip_pixel_count;
    return TilePixel(traced_pixel(frame.film_first_pixel + in_film, frame.camera), in_strip, exists);
}

#endif
