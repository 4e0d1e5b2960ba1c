/** @file
 * pt: samples in the background, while the program does something else.
 *
 * pt_start begins a pt_accumulate and returns at once; pt_poll goes on with it; pt_cancel ends it early. The pattern of
 * polls changes neither the image's bits nor the number of samples at which a target error is reached.
 *
 *     result = pt_start(context, &info);
 *     while (result == PT_PENDING) {
 *         ... a frame's other work ...
 *         result = pt_poll(context, 4000000, NULL);
 *     }
 *     if (result >= 0)
 *         result = pt_readback(context, &image);
 *
 * - Threads: the library starts none. Between calls each device works through at most two submissions
 *   (pt_create_info.submit_milliseconds); only pt_poll gives it more. To keep devices busy, let pt_poll wait for as
 *   long as the program can spare, or make submissions longer than the time between two polls. Any thread may poll, one
 *   at a time, and cancel, also while another one polls.
 * - Samples are under way from a pt_start that returns PT_PENDING to the first pt_poll that returns anything else.
 *   Meanwhile all other calls on the context are refused (PT_ERROR_INVALID_STATE), except pt_cancel,
 *   pt_get_context_device, pt_last_error, pt_get_broken_rule and pt_destroy, which waits for the submissions under way.
 *   To change scene or camera earlier, call pt_cancel, then pt_poll to the end: until the submissions under way and
 *   those that complete a sample of all pixels have ended.
 * - Ownership: pt_start copies its arguments.
 * - Callbacks: info.progress must be NULL, since pt_poll returns the progress. All others run within pt_start and
 *   pt_poll, on their thread.
 * - Failures: whole samples are kept, as by pt_accumulate. A pt_poll that fails has ended the work under way, perhaps
 *   after waiting longer than asked. Any call on the context may follow, unless the device is lost.
 */
#ifndef PT_ASYNC_H
#define PT_ASYNC_H

#include <pt/pt.h>

#ifdef __cplusplus
extern "C" {
#endif

/** Begins to add samples without waiting for them.
 *
 * PT_PENDING: samples are under way, to be polled. PT_TARGET_REACHED: the image has the target error already, and
 * nothing is under way. Builds all kernels for the samples (pt_prepare builds most of them ahead). Checks a target
 * error first if the image has a number of samples at which it is checked.
 *
 * One thread at a time per context. Fails as pt_accumulate does, and with PT_ERROR_INVALID_ARGUMENT if info.progress is
 * not NULL. */
PT_API pt_result pt_start(pt_context *context, const pt_accumulate_info *info);

/** Takes in finished work, gives the devices more, and waits for at most this many nanoseconds.
 *
 * 0: does not wait. UINT64_MAX: waits until all is done. May take longer when a target error is checked, which reads
 * the image. Builds no kernel: a scene that deserves its own (PT_CREATE_NO_SCENE_KERNELS) gets it from the next
 * pt_start.
 *
 * fraction may be NULL. Otherwise it receives, unless the call fails, the share of the samples that is done, in [0, 1],
 * which never falls.
 *
 * One thread at a time per context. PT_PENDING: samples are still under way. Every other result ends what pt_start
 * began, except a refusal (in a callback, or while another thread is in a call). PT_OK: all samples are taken.
 * PT_TARGET_REACHED: fewer were enough. PT_CANCELLED: pt_cancel was called; fewer samples are taken, all of them whole.
 * PT_ERROR_INVALID_STATE: nothing is under way. PT_ERROR_OUT_OF_DEVICE_MEMORY, PT_ERROR_SHADER, PT_ERROR_DEVICE_LOST:
 * the driver said so. */
PT_API pt_result pt_poll(pt_context *context, uint64_t nanoseconds, double *fraction);

/** Asks for no more samples, and returns at once. pt_poll then ends what pt_start began, and a pt_accumulate under way
 * ends as if pt_progress_fn had asked to stop: with PT_CANCELLED, or with PT_OK if no sample was left to begin. A
 * second call does nothing more.
 *
 * Any thread, at any time before pt_destroy, also in callbacks and while another thread is in a call on the context.
 * PT_ERROR_INVALID_STATE: nothing is under way, as when another thread has just polled to the end. */
PT_API pt_result pt_cancel(pt_context *context);

#ifdef __cplusplus
}
#endif

#endif
