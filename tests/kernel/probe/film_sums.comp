#version 450
#extension GL_GOOGLE_include_directive : require

#include "film.glsl"

layout(local_size_x = WORKGROUP_SIZE) in;
layout(push_constant) uniform Push { uint per_pixel; uint count; uint film_part; };
layout(set = 0, binding = 3) readonly buffer Input { vec4 samples[]; };

void main()
{
    uint pixel = gl_GlobalInvocationID.x;
    if (pixel >= count)
        return;
    FilmPixel gathered = empty_film_pixel();
    uint i = 0u;
    do {
        film_add(gathered, samples[pixel * per_pixel + i].rgb);
        ++i;
    } while (i < per_pixel);
    film_store(film_part, pixel, count, gathered, false, false);
}
