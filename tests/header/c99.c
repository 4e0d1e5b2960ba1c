#include <pt/accuracy.h>
#include <pt/pt.h>

#include <stdio.h>

enum { WIDTH = 16, HEIGHT = 8 };

static int failed(const char *call, const pt_context *context) {
    fprintf(stderr, "%s: %s\n", call, pt_last_error(context));
    return 1;
}

static int32_t count_calls(void *user, double fraction) {
    int *calls = user;
    ++*calls;
    return fraction < 0.0 || fraction > 1.0;
}

static int render(pt_context *context, float *pixels, uint64_t size_bytes) {
    const pt_material material = {{0.0f, 0.0f, 0.0f}, {0.0f, 0.0f, 0.0f}, {2.0f, 0.0f, 0.0f}, 0.0f, 0};
    const pt_sphere sphere = {{0.0, 0.0, 0.0}, 5.0, {0.0, 0.0, 0.0}, 0, 0};
    pt_scene scene = {0};
    pt_camera camera = {0};
    pt_render settings = {0};
    pt_accumulate_info samples = {0};
    pt_image image = {0};
    int calls = 0;

    scene.struct_size = sizeof scene;
    scene.material_count = 1;
    scene.materials = &material;
    scene.sphere_count = 1;
    scene.spheres = &sphere;
    camera.struct_size = sizeof camera;
    camera.target[2] = -1.0;
    settings.struct_size = sizeof settings;
    settings.width = WIDTH;
    settings.height = HEIGHT;
    samples.struct_size = sizeof samples;
    samples.sample_count = 4;
    samples.progress = count_calls;
    samples.progress_user = &calls;
    image.struct_size = sizeof image;
    image.data = pixels;
    image.size_bytes = size_bytes;

    if (pt_set_scene(context, &scene) != PT_OK)
        return failed("pt_set_scene", context);
    if (pt_set_camera(context, &camera) != PT_OK)
        return failed("pt_set_camera", context);
    if (pt_set_render(context, &settings) != PT_OK)
        return failed("pt_set_render", context);
    if (pt_accumulate(context, &samples) != PT_OK)
        return failed("pt_accumulate", context);
    if (pt_readback(context, &image) != PT_OK)
        return failed("pt_readback", context);
    if (calls == 0) {
        fprintf(stderr, "no progress was told\n");
        return 1;
    }
    return 0;
}

static int check_accuracy(pt_context *context) {
    pt_function_accuracy rows[32];
    uint32_t count = 32;
    uint32_t i;

    if (pt_get_accuracy(context, rows, &count) != PT_OK)
        return failed("pt_get_accuracy", context);
    for (i = 0; i < count; ++i) {
        if (!(rows[i].worst_error <= rows[i].bound)) {
            fprintf(stderr, "%s: %g ulp\n", rows[i].name, rows[i].worst_error);
            return 1;
        }
    }
    return count == 0;
}

int main(void) {
    static float pixels[WIDTH * HEIGHT * 3];
    pt_context *context;
    int status;
    int i;

    if (pt_version() != PT_VERSION) {
        fprintf(stderr, "the library is not that of the header\n");
        return 1;
    }
    if (pt_create(0, &context) != PT_OK)
        return failed("pt_create", 0);
    status = render(context, pixels, sizeof pixels);
    if (status == 0)
        status = check_accuracy(context);
    pt_destroy(context);
    for (i = 0; status == 0 && i < WIDTH * HEIGHT * 3; ++i) {
        if (pixels[i] != (i % 3 == 0 ? 2.0f : 0.0f)) {
            fprintf(stderr, "value %d is %g\n", i, (double)pixels[i]);
            status = 1;
        }
    }
    return status;
}
