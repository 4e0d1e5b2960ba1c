/* The smallest program: a ball under a lamp, written to smallest.ppm.
 *
 *     cc smallest.c $(pkg-config --cflags --libs pt) -o smallest && ./smallest
 */
#include <pt/display.h>
#include <pt/pt.h>

#include <stdio.h>

enum { WIDTH = 128, HEIGHT = 96 };

/* Makes each call only if all earlier calls succeeded. A result > 0 is a remark, not a failure. */
static pt_result render(pt_context *context, float *pixels, uint64_t size_bytes) {
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
    pt_scene scene = {0};
    pt_camera camera = {0};
    pt_render settings = {0};
    pt_accumulate_info samples = {0};
    pt_image image = {0};
    pt_result result;

    scene.struct_size = sizeof scene;
    scene.materials = materials;
    scene.material_count = 3;
    scene.spheres = spheres;
    scene.sphere_count = 2;
    scene.planes = &floor;
    scene.plane_count = 1;

    camera.struct_size = sizeof camera;
    camera.position[1] = 1.5;
    camera.position[2] = 5.0;
    camera.target[1] = 1.0;

    settings.struct_size = sizeof settings;
    settings.width = WIDTH;
    settings.height = HEIGHT;

    samples.struct_size = sizeof samples;
    samples.sample_count = 64;

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

/* Makes sRGB bytes, as in PPM and PNG files. */
static pt_result to_bytes(const float *pixels, uint8_t *bytes, uint64_t size_bytes) {
    pt_display_info display = {0};

    display.struct_size = sizeof display;
    display.automatic_exposure = 1;
    display.pixel_count = WIDTH * HEIGHT;
    display.radiance = pixels;
    display.pixels = bytes;
    display.size_bytes = size_bytes;
    return pt_display(&display);
}

static int write_ppm(const char *path, const uint8_t *bytes, size_t size) {
    FILE *file = fopen(path, "wb");
    int whole;

    if (!file)
        return 0;
    whole = fprintf(file, "P6\n%d %d\n255\n", WIDTH, HEIGHT) > 0 && fwrite(bytes, 1, size, file) == size;
    return fclose(file) == 0 && whole;
}

int main(void) {
    static float pixels[WIDTH * HEIGHT * 3];
    static uint8_t bytes[WIDTH * HEIGHT * 3];
    pt_context *context;
    pt_result result = pt_create(NULL, &context);

    if (result < 0) { /* there is no context, so pt_last_error gets NULL */
        fprintf(stderr, "%s: %s\n", pt_result_name(result), pt_last_error(NULL));
        return 1;
    }
    result = render(context, pixels, sizeof pixels);
    if (result < 0) /* before pt_destroy, which frees the message */
        fprintf(stderr, "%s: %s\n", pt_result_name(result), pt_last_error(context));
    pt_destroy(context);
    if (result < 0)
        return 1;

    if (to_bytes(pixels, bytes, sizeof bytes) < 0) {
        fprintf(stderr, "%s\n", pt_last_error(NULL));
        return 1;
    }
    if (!write_ppm("smallest.ppm", bytes, sizeof bytes)) {
        perror("smallest.ppm");
        return 1;
    }
    return 0;
}
