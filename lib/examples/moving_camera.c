/* A camera circles a ball. Each frame takes a few samples while the program does other work, without threads. The last
 * frame is written to moving_camera.pfm.
 *
 *     moving_camera [FRAMES [SAMPLES]]
 *
 * Exit status 0 if every frame was rendered and the last one was written.
 */
#include "ball.h"

#include <pt/async.h>

#include <math.h>
#include <stdlib.h>

/* The longest wait in a poll. 2 ms are short for a program with 60 frames a second. */
static const uint64_t poll_nanoseconds = 2000000;

/* An interactive program handles input here, and draws the previous frame. */
static void do_other_work(unsigned long *times) {
    ++*times;
}

/* A new camera discards the samples of the previous frame. */
static pt_result move_camera(pt_context *context, double turns) {
    const double angle = turns * 6.283185307179586;
    pt_camera camera = {.struct_size = sizeof camera, .target = {0.0, 1.0, 0.0}};

    camera.position[0] = 5.0 * sin(angle);
    camera.position[1] = 1.5;
    camera.position[2] = 5.0 * cos(angle);
    return pt_set_camera(context, &camera);
}

/* The device works meanwhile, but the program must poll. */
static pt_result render_frame(pt_context *context, const pt_accumulate_info *samples, const pt_image *image,
                              unsigned long *other_work) {
    pt_result result = pt_start(context, samples);

    while (result == PT_PENDING) {
        do_other_work(other_work);
        result = pt_poll(context, poll_nanoseconds, NULL);
    }
    if (result >= 0)
        result = pt_readback(context, image);
    return result;
}

static pt_result render_frames(pt_context *context, unsigned frames, const pt_accumulate_info *samples,
                               const pt_image *image) {
    unsigned long other_work = 0;
    unsigned frame;
    pt_result result = set_up_ball(context);

    if (result >= 0)
        result = pt_prepare(context); /* compiles the kernel before the first frame */
    for (frame = 0; result >= 0 && frame < frames; ++frame) {
        result = move_camera(context, (double)frame / frames);
        if (result >= 0)
            result = render_frame(context, samples, image, &other_work);
    }
    if (result >= 0)
        printf("%u frames of %u samples per pixel; other work was done %lu times\n", frames,
               (unsigned)samples->sample_count, other_work);
    return result;
}

int main(int argc, char **argv) {
    static float pixels[WIDTH * HEIGHT * 3];
    const pt_image image = {.struct_size = sizeof image, .data = pixels, .size_bytes = sizeof pixels};
    const unsigned frames = argc > 1 ? (unsigned)strtoul(argv[1], NULL, 10) : 120;
    const pt_accumulate_info samples = {.struct_size = sizeof samples,
                                        .sample_count = argc > 2 ? (uint32_t)strtoul(argv[2], NULL, 10) : 2};
    /* A kernel with the scene's numbers as constants would take more time than it saves, because the camera moves. */
    const pt_create_info create = {.struct_size = sizeof create, .flags = PT_CREATE_NO_SCENE_KERNELS};
    pt_context *context;
    pt_result result = pt_create(&create, &context);

    if (result >= 0)
        result = render_frames(context, frames, &samples, &image);
    if (result < 0)
        fprintf(stderr, "%s: %s\n", pt_result_name(result), pt_last_error(context));
    pt_destroy(context);
    if (result >= 0 && !write_pfm("moving_camera.pfm", pixels)) {
        perror("moving_camera.pfm");
        return EXIT_FAILURE;
    }
    return result >= 0 ? EXIT_SUCCESS : EXIT_FAILURE;
}
