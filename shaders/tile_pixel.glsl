// The pixel of an invocation: a workgroup has a tile of the film, and a list says which. Uses FrameConstants frame.
#ifndef TILE_PIXEL_GLSL
#define TILE_PIXEL_GLSL

// The first pixel of each tile, in the film.
layout(set = 0, binding = BINDING_TILES) readonly buffer Tiles { uint first_pixels[]; } tiles;

struct TilePixel {
    uint in_image;
    uint in_strip;
    bool exists; // tiles at the image's edges, and where a strip ends within them, have fewer pixels than invocations
};

// What would come before the strip wraps around, and lies far behind it.
TilePixel tile_pixel()
{
    uint corner = tiles.first_pixels[frame.first_entry + gl_WorkGroupID.x];
    uint column = gl_LocalInvocationID.x % TILE_SIZE;
    uint in_film = corner + gl_LocalInvocationID.x / TILE_SIZE * frame.camera.width + column;
    uint in_strip = in_film - frame.strip_first_pixel;
    bool exists = corner % frame.camera.width + column < frame.camera.width && in_strip < frame.strip_pixel_count;
    return TilePixel(frame.film_first_pixel + in_film, in_strip, exists);
}

#endif
