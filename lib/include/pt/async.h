/** @file
 * pt: samples in the background, while the program does something else.
 *
 * pt_start begins a pt_accumulate and returns at once, pt_poll continues it, and pt_cancel ends it early. Neither the
 * image's bits nor the number of samples depends on when pt_poll is called.
 *
 * - Devices: The library starts no threads. Between calls each device has at most two submissions, and only pt_poll
 *   gives it more. To keep devices busy, let pt_poll wait, or make submissions longer than the time between two polls
 *   (pt_create_info.submit_milliseconds).
 * - State: Samples are being taken after pt_start has returned PT_PENDING, until pt_poll returns another result.
 *   Meanwhile other calls on the context return PT_ERROR_INVALID_STATE. Exceptions are pt_cancel,
 *   pt_get_context_device, pt_last_error, pt_get_broken_rule and pt_destroy, which waits for the current submissions.
 *   To change scene or camera earlier, call pt_cancel, then pt_poll until it does not return PT_PENDING.
 * - Callbacks: info.progress must be NULL, since pt_poll returns the progress. All other callbacks run within pt_start
 *   and pt_poll, on the calling thread.
 * - Failures: Complete samples are kept, as by pt_accumulate. A pt_poll that fails first waits for all submissions,
 *   perhaps longer than asked.
 */
#ifndef PT_ASYNC_H
#define PT_ASYNC_H

#include <pt/pt.h>

#ifdef __cplusplus
extern "C" {
#endif

/** Begins to add samples without waiting for them.
 *
 * Builds all kernels for the samples (pt_prepare builds most of them ahead). Checks a target error first if the image
 * has a number of samples that pt_next_check returns.
 *
 * One thread at a time. PT_PENDING: samples are being taken. PT_TARGET_REACHED: the image already has the target error,
 * and no samples are being taken. Fails as pt_accumulate does. */
PT_API pt_result pt_start(pt_context *context, const pt_accumulate_info *info);

/** Gives the devices more work, and waits for at most the given number of nanoseconds. UINT64_MAX waits until all
 * samples are taken.
 *
 * The call may take longer when it checks a target error, which reads the image. pt_poll builds no kernel. fraction may
 * be NULL. Otherwise it receives the finished fraction of the samples, in [0, 1], which never decreases.
 *
 * One thread at a time. PT_PENDING: samples are still being taken. PT_OK: all samples are taken. PT_TARGET_REACHED,
 * PT_LIMIT_REACHED: see pt_stopping. PT_CANCELLED: pt_cancel was called; fewer samples are taken, all of them complete.
 * PT_ERROR_INVALID_STATE: no samples are being taken. The same error in a callback, or during another thread's call,
 * does not end the sampling. */
PT_API pt_result pt_poll(pt_context *context, uint64_t nanoseconds, double *fraction);

/** Asks the context to stop taking samples, and returns at once.
 *
 * After pt_start, call pt_poll until it does not return PT_PENDING. pt_poll completes the current sample of all pixels.
 * A running pt_accumulate ends as if pt_progress_fn had asked to stop, with PT_CANCELLED, or with PT_OK if all samples
 * had begun.
 *
 * Any thread, at any time before pt_destroy, also in callbacks and while another thread is in a call on the context.
 * PT_ERROR_INVALID_STATE: no samples are being taken. */
PT_API pt_result pt_cancel(pt_context *context);

#ifdef __cplusplus
}
#endif

#endif
