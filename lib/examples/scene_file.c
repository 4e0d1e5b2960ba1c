/* Renders a scene file to scene_file.pfm (linear radiance as floats). Errors name the line of the file.
 *
 *     cc scene_file.c $(pkg-config --cflags --libs pt pt-scene) -o scene_file && ./scene_file scene.json [path=value...]
 */
#include <pt/pt.h>
#include <pt/scene_file.h>

#include <stdio.h>
#include <stdlib.h>

enum { MOST_OVERRIDES = 16 };

/* Prints each broken rule with its source in the file. For other errors prints the library's message. */
static void explain(pt_scene_file *file, const pt_context *context) {
    uint32_t i;

    for (i = 0;; ++i) {
        pt_broken_rule rule = {0};
        pt_rule_source source = {0};

        rule.struct_size = sizeof rule;
        source.struct_size = sizeof source;
        pt_get_broken_rule(context, i, &rule);
        if (!rule.subject || pt_find_rule_source(file, &rule, &source) < 0)
            break;
        fprintf(stderr, "%s\n", source.message);
    }
    if (i == 0)
        fprintf(stderr, "%s\n", pt_last_error(context));
}

static pt_result render(pt_context *context, const pt_scene_file *file, float **pixels, pt_render *settings) {
    pt_scene scene = {0};
    pt_camera camera = {0};
    pt_scene_film film = {0};
    pt_accumulate_info samples = {0};
    pt_image image = {0};
    pt_result result;

    scene.struct_size = sizeof scene;
    camera.struct_size = sizeof camera;
    settings->struct_size = sizeof *settings;
    film.struct_size = sizeof film;
    result = pt_get_scene_file(file, &scene, &camera, settings, &film);
    if (result >= 0)
        result = pt_set_scene(context, &scene);
    if (result >= 0)
        result = pt_set_camera(context, &camera);
    if (result >= 0)
        result = pt_set_render(context, settings);
    if (result < 0)
        return result;

    samples.struct_size = sizeof samples;
    samples.sample_count = film.sample_count ? film.sample_count : 64;
    image.struct_size = sizeof image;
    image.size_bytes = (uint64_t)settings->width * settings->height * 3 * sizeof(float);
    image.data = *pixels = malloc(image.size_bytes);
    if (!image.data)
        return PT_ERROR_OUT_OF_HOST_MEMORY;
    result = pt_accumulate(context, &samples);
    return result < 0 ? result : pt_readback(context, &image);
}

/* PFM has the bottom row first; -1 in its header means little-endian. */
static int write_pfm(const char *path, const float *pixels, const pt_render *settings) {
    const size_t row_numbers = (size_t)settings->width * 3;
    FILE *file = fopen(path, "wb");
    uint32_t row;
    int whole;

    if (!file)
        return 0;
    whole = fprintf(file, "PF\n%u %u\n-1.0\n", (unsigned)settings->width, (unsigned)settings->height) > 0;
    for (row = settings->height; row-- > 0;)
        whole = whole && fwrite(pixels + row * row_numbers, sizeof(float), row_numbers, file) == row_numbers;
    return fclose(file) == 0 && whole;
}

int main(int count, char **arguments) {
    pt_scene_override overrides[MOST_OVERRIDES] = {{0}};
    pt_scene_file_info info = {0};
    pt_scene_file *file = NULL;
    pt_context *context = NULL;
    pt_render settings = {0};
    float *pixels = NULL;
    int is_written = 0;
    int i;

    info.struct_size = sizeof info;
    info.path = count > 1 ? arguments[1] : NULL;
    for (i = 2; i < count && i - 2 < MOST_OVERRIDES; ++i)
        overrides[info.override_count++].setting = arguments[i];
    info.overrides = overrides;
    if (pt_open_scene_file(&info, &file) < 0) {
        fprintf(stderr, "%s\n", pt_last_scene_error());
        return 1;
    }
    if (pt_create(NULL, &context) < 0)
        fprintf(stderr, "%s\n", pt_last_error(NULL));
    else if (render(context, file, &pixels, &settings) < 0)
        explain(file, context);
    else if (!(is_written = write_pfm("scene_file.pfm", pixels, &settings)))
        perror("scene_file.pfm");
    free(pixels);
    pt_destroy(context);
    pt_close_scene_file(file);
    return is_written ? 0 : 1;
}
