/* Ten thousand particles have positions and colors in arrays, and a common radius. pt_set_scene reads the arrays in
 * place. The picture is written to particles.pfm.
 *
 *     particles [COUNT [SAMPLES]]
 */
#include "ball.h"

#include <math.h>
#include <stdlib.h>

typedef struct particles {
    uint32_t count;
    float (*positions)[3];
    uint8_t (*colors)[3]; /* sRGB, as in color maps */
    float radius;
} particles;

/* Arranges the particles in a sunflower's spiral, bent into a bowl: orange in the middle, blue at the rim. */
static void arrange(particles *all) {
    const double golden_angle = 2.39996322972865332;
    uint32_t i;

    for (i = 0; i < all->count; ++i) {
        const double share = (i + 0.5) / all->count;
        const double distance = 2.0 * sqrt(share);

        all->positions[i][0] = (float)(distance * cos(i * golden_angle));
        all->positions[i][1] = (float)(0.8 * share);
        all->positions[i][2] = (float)(distance * sin(i * golden_angle));
        all->colors[i][0] = (uint8_t)(255.0 * (1.0 - 0.8 * share));
        all->colors[i][1] = 150;
        all->colors[i][2] = (uint8_t)(255.0 * (0.2 + 0.8 * share));
    }
    all->radius = (float)(1.7 / sqrt(all->count));
}

static pt_result set_scene(pt_context *context, const particles *all) {
    static const pt_material materials[] = {
        {{1.0f, 1.0f, 1.0f}, {0.0f, 0.0f, 0.0f}, {0.0f, 0.0f, 0.0f}, 0.0f, 0}, /* white keeps the particles' colors */
        {{0.0f, 0.0f, 0.0f}, {0.0f, 0.0f, 0.0f}, {40.0f, 40.0f, 36.0f}, 0.0f, 0}, /* a lamp */
    };
    static const pt_sphere lamp = {{2.0, 5.0, 2.0}, 1.0, {0.0, 0.0, 0.0}, 1, 0};
    const pt_sphere_array array = {
        .struct_size = sizeof array,
        .count = all->count,
        .center = {all->positions, sizeof all->positions[0], PT_TYPE_FLOAT32},
        .radius = {&all->radius, 0, PT_TYPE_FLOAT32},
        .color = {all->colors, sizeof all->colors[0], PT_TYPE_SRGB8},
    };
    const pt_scene scene = {
        .struct_size = sizeof scene,
        .material_count = 2,
        .materials = materials,
        .sphere_count = 1,
        .spheres = &lamp,
        .sphere_array_count = 1,
        .sphere_arrays = &array,
    };
    return pt_set_scene(context, &scene);
}

static pt_result render(pt_context *context, const particles *all, uint32_t sample_count, const pt_image *image) {
    const pt_camera camera = {.struct_size = sizeof camera, .position = {0.0, 3.0, 4.5}, .target = {0.0, 0.2, 0.0}};
    const pt_render settings = {.struct_size = sizeof settings, .width = WIDTH, .height = HEIGHT, .max_path_length = 3};
    const pt_accumulate_info samples = {.struct_size = sizeof samples, .sample_count = sample_count};
    pt_result result = set_scene(context, all);

    if (result >= 0)
        result = pt_set_camera(context, &camera);
    if (result >= 0)
        result = pt_set_render(context, &settings);
    if (result >= 0)
        result = pt_accumulate(context, &samples);
    if (result >= 0)
        result = pt_readback(context, image);
    return result;
}

static int render_to_file(const particles *all, uint32_t sample_count) {
    static float pixels[WIDTH * HEIGHT * 3];
    const pt_image image = {.struct_size = sizeof image, .data = pixels, .size_bytes = sizeof pixels};
    pt_context *context;
    pt_result result = pt_create(NULL, &context);

    if (result >= 0)
        result = render(context, all, sample_count, &image);
    if (result < 0) /* if pt_create failed, context is NULL */
        fprintf(stderr, "%s: %s\n", pt_result_name(result), pt_last_error(context));
    pt_destroy(context);
    if (result >= 0 && !write_pfm("particles.pfm", pixels)) {
        perror("particles.pfm");
        return EXIT_FAILURE;
    }
    return result >= 0 ? EXIT_SUCCESS : EXIT_FAILURE;
}

int main(int argc, char **argv) {
    const uint32_t sample_count = argc > 2 ? (uint32_t)strtoul(argv[2], NULL, 10) : 8;
    particles all = {.count = argc > 1 ? (uint32_t)strtoul(argv[1], NULL, 10) : 10000};
    int status = EXIT_FAILURE;

    all.positions = calloc(all.count, sizeof all.positions[0]);
    all.colors = calloc(all.count, sizeof all.colors[0]);
    if (all.positions && all.colors) {
        arrange(&all);
        status = render_to_file(&all, sample_count);
    } else {
        fprintf(stderr, "no memory for %u particles\n", (unsigned)all.count);
    }
    free(all.positions);
    free(all.colors);
    return status;
}
