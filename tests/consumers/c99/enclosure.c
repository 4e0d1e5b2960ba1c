/* A user's program in C99. Inside an emitting ball, every pixel must have exactly the ball's radiance. With an argument
 * the expected radiance is wrong, as a negative control. */
#include <pt/pt.h>

#include <stdio.h>
#include <stdlib.h>

enum { WIDTH = 8, HEIGHT = 4 };

static pt_result render(pt_context *context, float *pixels, uint64_t size_bytes) {
    const pt_material material = {{0.0f, 0.0f, 0.0f}, {0.0f, 0.0f, 0.0f}, {2.0f, 1.0f, 0.5f}, 0.0f, 0};
    const pt_sphere ball = {{0.0, 0.0, 0.0}, 3.0, {0.0, 0.0, 0.0}, 0, 0};
    pt_scene scene = {0};
    pt_camera camera = {0};
    pt_render settings = {0};
    pt_accumulate_info samples = {0};
    pt_image image = {0};
    pt_result result;

    scene.struct_size = sizeof scene;
    scene.materials = &material;
    scene.material_count = 1;
    scene.spheres = &ball;
    scene.sphere_count = 1;
    camera.struct_size = sizeof camera;
    camera.target[2] = -1.0;
    settings.struct_size = sizeof settings;
    settings.width = WIDTH;
    settings.height = HEIGHT;
    samples.struct_size = sizeof samples;
    samples.sample_count = 3;
    image.struct_size = sizeof image;
    image.data = pixels;
    image.size_bytes = size_bytes;

    result = pt_set_scene(context, &scene);
    if (result >= 0)
        result = pt_set_camera(context, &camera);
    if (result >= 0)
        result = pt_set_render(context, &settings);
    if (result >= 0)
        result = pt_accumulate(context, &samples);
    if (result >= 0)
        result = pt_readback(context, &image);
    return result;
}

int main(int argument_count, char **arguments) {
    float expected[3] = {2.0f, 1.0f, 0.5f};
    float pixels[WIDTH * HEIGHT * 3];
    pt_context *context;
    pt_result result = pt_create(NULL, &context);
    int i;

    if (argument_count > 1)
        expected[0] = (float)atof(arguments[1]);
    if (pt_version() != PT_VERSION)
        return 2;
    if (result < 0) {
        fprintf(stderr, "%s: %s\n", pt_result_name(result), pt_last_error(NULL));
        return 2;
    }
    result = render(context, pixels, sizeof pixels);
    if (result < 0)
        fprintf(stderr, "%s: %s\n", pt_result_name(result), pt_last_error(context));
    pt_destroy(context);
    if (result < 0)
        return 2;
    for (i = 0; i < WIDTH * HEIGHT * 3; ++i) {
        if (pixels[i] != expected[i % 3]) {
            fprintf(stderr, "value %d is %g, not %g\n", i, (double)pixels[i], (double)expected[i % 3]);
            return 1;
        }
    }
    return 0;
}
