/* Progressive display. A rendering thread works in steps that double the samples. After each step it writes
 * progressive.pfm and prints the error. The main thread shows the progress of the step. Ctrl-C or a time limit stops
 * the program.
 *
 *     progressive [SAMPLES [SECONDS]]
 *
 * Exit status 0 if an image was written, even if the program was stopped early.
 */
#define _POSIX_C_SOURCE 200809L

#include "ball.h"

#include <pt/stats.h>

#include <math.h>
#include <pthread.h>
#include <signal.h>
#include <stdatomic.h>
#include <stdlib.h>
#include <time.h>

static atomic_int stop; /* set by a signal or the main thread, read by the rendering thread */

/* Shared by both threads. While the rendering thread runs, only that thread uses the context. */
typedef struct render_job {
    pt_context *context;
    uint32_t samples;
    pt_result result;         /* valid when the thread has ended */
    atomic_int shown;         /* 1 if the last image was written */
    atomic_int step_permille; /* progress of the current step */
    atomic_int ended;
} render_job;

static void request_stop(int signal_number) {
    (void)signal_number;
    atomic_store(&stop, 1);
}

/* Called on the rendering thread. A result other than 0 ends pt_accumulate with PT_CANCELLED. */
static int32_t on_progress(void *user, double fraction) {
    render_job *job = user;
    atomic_store(&job->step_permille, (int)(fraction * 1000.0));
    return atomic_load(&stop);
}

static pt_result show(render_job *job, uint32_t sample_count) {
    static float pixels[WIDTH * HEIGHT * 3];
    const pt_image image = {.struct_size = sizeof image, .data = pixels, .size_bytes = sizeof pixels};
    pt_error_estimate error = {.struct_size = sizeof error};
    pt_result result = pt_readback(job->context, &image);

    if (result >= 0)
        result = pt_get_error_estimate(job->context, &error);
    if (result < 0)
        return result;
    /* The file is renamed when it is complete, so that a viewer never sees half an image. */
    atomic_store(&job->shown, write_pfm("progressive.pfm.part", pixels) &&
                                  rename("progressive.pfm.part", "progressive.pfm") == 0);
    if (!atomic_load(&job->shown)) {
        perror("progressive.pfm");
        atomic_store(&stop, 1);
    }
    printf("\r%u samples", (unsigned)sample_count);
    if (isfinite(error.relative_rmse)) /* finite from 16 samples on */
        printf(", error %.2g%%", 100.0 * error.relative_rmse);
    printf("          \n");
    return result;
}

/* The split into steps does not change the image's bits. */
static pt_result render_in_steps(render_job *job) {
    pt_stats stats = {.struct_size = sizeof stats};
    pt_accumulate_info step = {.struct_size = sizeof step, .sample_count = 1};
    pt_result result = set_up_ball(job->context);

    step.progress = on_progress;
    step.progress_user = job;
    while (result == PT_OK && stats.sample_count < job->samples) {
        const uint32_t missing = job->samples - stats.sample_count;
        step.sample_count = step.sample_count < missing ? step.sample_count : missing;
        const pt_result accumulated = pt_accumulate(job->context, &step); /* PT_CANCELLED keeps complete samples */
        result = accumulated < 0 ? accumulated : pt_get_stats(job->context, &stats);
        if (result >= 0 && stats.sample_count > 0)
            result = show(job, stats.sample_count);
        if (result >= 0)
            result = accumulated;
        step.sample_count = stats.sample_count > 0 ? stats.sample_count : 1;
    }
    return result;
}

static void *render_thread(void *user) {
    render_job *job = user;
    job->result = render_in_steps(job);
    atomic_store(&job->ended, 1);
    return NULL;
}

/* Waits for the thread. After `seconds`, unless 0, asks it to stop as soon as an image was shown. */
static void watch(render_job *job, double seconds) {
    const struct timespec pause = {0, 20000000};
    double waited = 0.0; /* a little less than the true time */

    while (!atomic_load(&job->ended)) {
        printf("\r%3d%% of this step", atomic_load(&job->step_permille) / 10);
        fflush(stdout);
        nanosleep(&pause, NULL);
        waited += 0.02;
        if (seconds > 0.0 && waited >= seconds && atomic_load(&job->shown))
            atomic_store(&stop, 1);
    }
    printf("\n");
}

int main(int argc, char **argv) {
    render_job job = {.samples = argc > 1 ? (uint32_t)strtoul(argv[1], NULL, 10) : 1024};
    const double seconds = argc > 2 ? strtod(argv[2], NULL) : 0.0;
    pthread_t thread;

    if (pt_create(NULL, &job.context) < 0) {
        fprintf(stderr, "%s\n", pt_last_error(NULL));
        return EXIT_FAILURE;
    }
    signal(SIGINT, request_stop);
    if (pthread_create(&thread, NULL, render_thread, &job) != 0) {
        fprintf(stderr, "no thread\n");
        pt_destroy(job.context);
        return EXIT_FAILURE;
    }
    watch(&job, seconds);
    pthread_join(thread, NULL);
    if (job.result < 0)
        fprintf(stderr, "%s: %s\n", pt_result_name(job.result), pt_last_error(job.context));
    pt_destroy(job.context);
    return job.result >= 0 && atomic_load(&job.shown) ? EXIT_SUCCESS : EXIT_FAILURE;
}
