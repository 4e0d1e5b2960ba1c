/* A camera that circles a ball: each frame takes a few samples while the program does its other work, and is read as
 * soon as they are done. No threads. The last frame is written to moving_camera.pfm (linear radiance as floats).
 *
 *     moving_camera [FRAMES [SAMPLES]]
 *
 * Exit status 0 if every frame was rendered and the last one written.
 */
#define _POSIX_C_SOURCE 200112L

#include <pt/async.h>
#include <pt/pt.h>

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <time.h>

enum { WIDTH = 128, HEIGHT = 96 };

/* How long a poll may wait in a program with 60 frames a second, nanoseconds; repeated until the frame's samples are
 * done. */
static const uint64_t poll_nanoseconds = 2000000;

/* The program's other work. An interactive program handles input here, and draws the previous frame. */
typedef struct other_work {
    unsigned long times;
} other_work;

static void do_other_work(other_work *work) {
    ++work->times;
}

static double seconds_now(void) {
    struct timespec now;
    clock_gettime(CLOCK_MONOTONIC, &now);
    return (double)now.tv_sec + 1e-9 * (double)now.tv_nsec;
}

static pt_result set_up(pt_context *context) {
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
    const pt_render render = {.struct_size = sizeof render, .width = WIDTH, .height = HEIGHT};
    pt_result result = pt_set_scene(context, &scene);

    if (result >= 0)
        result = pt_set_render(context, &render);
    return result;
}

/* Moves the camera, which goes once around the ball. This discards the samples of the previous frame. */
static pt_result move_camera(pt_context *context, double turns) {
    const double angle = turns * 6.283185307179586;
    pt_camera camera = {.struct_size = sizeof camera, .target = {0.0, 1.0, 0.0}};

    camera.position[0] = 5.0 * sin(angle);
    camera.position[1] = 1.5;
    camera.position[2] = 5.0 * cos(angle);
    return pt_set_camera(context, &camera);
}

/* Takes the samples of a frame. The device works while the program goes on, which has to poll. */
static pt_result render_frame(pt_context *context, const pt_accumulate_info *samples, const pt_image *image,
                              other_work *work) {
    pt_result result = pt_start(context, samples);

    while (result == PT_PENDING) {
        do_other_work(work);
        result = pt_poll(context, poll_nanoseconds, NULL);
    }
    if (result >= 0)
        result = pt_readback(context, image);
    return result;
}

/* Prints the number of frames, and how many a second there were. */
static pt_result render_frames(pt_context *context, unsigned frames, const pt_accumulate_info *samples,
                               const pt_image *image) {
    other_work work = {0};
    double begin;
    unsigned frame;
    pt_result result = set_up(context);

    if (result >= 0)
        result = move_camera(context, 0.0);
    if (result >= 0)
        result = pt_prepare(context); /* so that the first frame waits for no kernel */
    begin = seconds_now();
    for (frame = 0; result >= 0 && frame < frames; ++frame) {
        result = move_camera(context, (double)frame / frames);
        if (result >= 0)
            result = render_frame(context, samples, image, &work);
    }
    if (result >= 0)
        printf("%u frames of %u samples per pixel, %.1f a second; other work was done %lu times\n", frames,
               (unsigned)samples->sample_count, frames / (seconds_now() - begin), work.times);
    return result;
}

/* Writes a file; returns 1 if it is whole. PFM wants the bottom row first; -1 says that the floats are
 * little-endian. */
static int write_pfm(const char *path, const float *pixels) {
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

int main(int argc, char **argv) {
    static float pixels[WIDTH * HEIGHT * 3];
    const pt_image image = {.struct_size = sizeof image, .data = pixels, .size_bytes = sizeof pixels};
    const unsigned frames = argc > 1 ? (unsigned)strtoul(argv[1], NULL, 10) : 120;
    const pt_accumulate_info samples = {.struct_size = sizeof samples,
                                        .sample_count = argc > 2 ? (uint32_t)strtoul(argv[2], NULL, 10) : 2};
    /* A moving camera never rests long enough for a kernel of the scene's own to pay off. */
    const pt_create_info create = {.struct_size = sizeof create, .flags = PT_CREATE_NO_SCENE_KERNELS};
    pt_context *context;
    pt_result result = pt_create(&create, &context);

    if (result < 0) {
        fprintf(stderr, "%s\n", pt_last_error(NULL));
        return EXIT_FAILURE;
    }
    result = render_frames(context, frames, &samples, &image);
    if (result < 0)
        fprintf(stderr, "%s: %s\n", pt_result_name(result), pt_last_error(context));
    pt_destroy(context);
    if (result < 0)
        return EXIT_FAILURE;
    if (!write_pfm("moving_camera.pfm", pixels)) {
        perror("moving_camera.pfm");
        return EXIT_FAILURE;
    }
    return EXIT_SUCCESS;
}
