// The pixel of an invocation, one of a range of the strip or of a list of its tiles. Uses FrameConstants frame.
#ifndef TILE_LIST_GLSL
#define TILE_LIST_GLSL

// The first pixel of each tile, in the strip.
layout(set = 0, binding = BINDING_TILES) readonly buffer Tiles { uint first_pixels[]; } tiles;

// Whether this invocation has a pixel: the last workgroup of a range, and tiles at the image's edges, have fewer than
// there are invocations.
bool has_pixel(bool of_list, out uint pixel_in_strip)
{
    if (!of_list) {
        pixel_in_strip = frame.first_pixel + gl_GlobalInvocationID.x;
        return gl_GlobalInvocationID.x < frame.pixel_count;
    }
    uint corner = tiles.first_pixels[frame.first_pixel + gl_WorkGroupID.x];
    uint column = (frame.strip_first_pixel + corner) % frame.width + gl_LocalInvocationID.x % TILE_SIZE;
    pixel_in_strip = corner + gl_LocalInvocationID.x / TILE_SIZE * frame.width + gl_LocalInvocationID.x % TILE_SIZE;
    return column < frame.width && pixel_in_strip < frame.strip_pixel_count;
}

#endif
