/* A user's program in C99. Inside an emitting ball, every pixel must have exactly the ball's radiance. With an argument
 * the expected radiance is wrong, as a negative control. */
#include <pt/pt.h>

#include <stdio.h>
#include <stdlib.h>

enum { WIDTH = 8, HEIGHT = 4, VALUES = WIDTH * HEIGHT * 3 };

int main(int argument_count, char **arguments) {
    static const pt_material lamp = {.emission = {2.0f, 1.0f, 0.5f}};
    static const pt_sphere ball = {.radius = 3.0};
    static float pixels[VALUES];
    const float expected[3] = {argument_count > 1 ? (float)atof(arguments[1]) : 2.0f, 1.0f, 0.5f};
    const pt_scene scene = {
        .struct_size = sizeof scene, .material_count = 1, .sphere_count = 1, .materials = &lamp, .spheres = &ball};
    const pt_camera camera = {.struct_size = sizeof camera, .target = {0.0, 0.0, -1.0}};
    const pt_render render = {.struct_size = sizeof render, .width = WIDTH, .height = HEIGHT};
    const pt_accumulate_info samples = {.struct_size = sizeof samples, .sample_count = 3};
    const pt_image image = {.struct_size = sizeof image, .data = pixels, .size_bytes = sizeof pixels};
    pt_context *context = NULL;
    int i;

    if (pt_version() != PT_VERSION || pt_create(NULL, &context) < 0 || pt_set_scene(context, &scene) < 0 ||
        pt_set_camera(context, &camera) < 0 || pt_set_render(context, &render) < 0 ||
        pt_accumulate(context, &samples) < 0 || pt_readback(context, &image) < 0) {
        fprintf(stderr, "%s\n", pt_last_error(context));
        return 2;
    }
    pt_destroy(context);
    for (i = 0; i < VALUES; ++i) {
        if (pixels[i] != expected[i % 3]) {
            fprintf(stderr, "value %d is %g, not %g\n", i, (double)pixels[i], (double)expected[i % 3]);
            return 1;
        }
    }
    return 0;
}
