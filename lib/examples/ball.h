/* Shared by examples: the scene of smallest.c, and a function that writes a picture's linear radiance as floats (PFM).
 * GIMP and tev show such files. */
#ifndef BALL_H
#define BALL_H

#include <pt/pt.h>

#include <stdio.h>

enum { WIDTH = 128, HEIGHT = 96 };

static inline pt_result set_up_ball(pt_context *context) {
    static const pt_material materials[] = {
        {{0.8f, 0.8f, 0.8f}, {0.0f, 0.0f, 0.0f}, {0.0f, 0.0f, 0.0f}, 0.0f, 0},    /* white, matt */
        {{0.4f, 0.1f, 0.1f}, {0.4f, 0.4f, 0.4f}, {0.0f, 0.0f, 0.0f}, 100.0f, 0},  /* red, glossy */
        {{0.0f, 0.0f, 0.0f}, {0.0f, 0.0f, 0.0f}, {40.0f, 40.0f, 36.0f}, 0.0f, 0}, /* a lamp */
    };
    static const pt_sphere spheres[] = {
        {{0.0, 1.0, 0.0}, 1.0, {0.0, 0.0, 0.0}, 1, 0},
        {{2.0, 4.0, 2.0}, 1.0, {0.0, 0.0, 0.0}, 2, 0},
    };
    static const pt_plane floor = {{0.0, 1.0, 0.0}, 0.0, 0, 0};
    const pt_scene scene = {
        .struct_size = sizeof scene,
        .material_count = 3,
        .sphere_count = 2,
        .plane_count = 1,
        .materials = materials,
        .spheres = spheres,
        .planes = &floor,
    };
    const pt_camera camera = {.struct_size = sizeof camera, .position = {0.0, 1.5, 5.0}, .target = {0.0, 1.0, 0.0}};
    const pt_render render = {.struct_size = sizeof render, .width = WIDTH, .height = HEIGHT};
    pt_result result = pt_set_scene(context, &scene);

    if (result >= 0)
        result = pt_set_camera(context, &camera);
    if (result >= 0)
        result = pt_set_render(context, &render);
    return result;
}

/* Returns 1 if the file is complete. PFM has the bottom row first; -1 in its header means little-endian. */
static inline int write_pfm(const char *path, const float *pixels) {
    FILE *file = fopen(path, "wb");
    int row;
    int whole;

    if (!file)
        return 0;
    whole = fprintf(file, "PF\n%d %d\n-1.0\n", WIDTH, HEIGHT) > 0;
    for (row = HEIGHT; row-- > 0;)
        whole = whole && fwrite(pixels + row * WIDTH * 3, sizeof(float), WIDTH * 3, file) == WIDTH * 3;
    return fclose(file) == 0 && whole;
}

#endif
