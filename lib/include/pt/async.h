/** @file
 * pt: samples that are taken while the program does something else.
 *
 * pt_start begins what pt_accumulate does and returns at once; pt_poll goes on with it; pt_cancel ends it early.
 * Whatever the pattern of polls, the image has the bits that pt_accumulate gives it, and a target error is reached at
 * the same number of samples.
 *
 *     result = pt_start(context, &info);
 *     while (result == PT_PENDING) {
 *         ... a frame's other work ...
 *         result = pt_poll(context, 4000000, NULL);
 *     }
 *     if (result >= 0)
 *         result = pt_readback(context, &image);
 *
 * - Threads: the library starts none. Between calls the devices work on what they have been given, two submissions each
 *   at the most (pt_create_info.submit_milliseconds), and nothing happens on the host: they are given more by pt_poll
 *   alone. A program that lets pt_poll wait for the time that it has to spare keeps them busy; one that does not is
 *   better off with submissions that are longer than the time between two polls. Any thread may poll, one at a time,
 *   and cancel, also while another one polls.
 * - While samples are under way, from a pt_start that returns PT_PENDING to the first pt_poll that returns anything
 *   else, other calls on the context are refused (PT_ERROR_INVALID_STATE) and change nothing, but for pt_cancel,
 *   pt_get_context_device, pt_last_error and pt_get_broken_rule, and pt_destroy, which waits for the submissions under
 *   way. To change the scene or the camera at any time: pt_cancel, then pt_poll to the end, which is as far as the
 *   submissions under way and, where one sample of all pixels takes several, those that complete it.
 * - Ownership: pt_start copies what it is given, and nothing has to stay, but for what has to for the life of the
 *   context. A device that was lent (pt/vulkan.h) must not be destroyed, as ever.
 * - Callbacks: info.progress must be NULL, since pt_poll says how far the samples are. The log, the functions that keep
 *   kernels and those that lock a lent queue are called in pt_start and pt_poll, on the thread that calls these, and
 *   never between calls.
 * - Failures: as of pt_accumulate, whole samples are kept. A pt_poll that fails has ended what was under way, for which
 *   it may wait longer than it was asked to. Any call on the context may follow, unless the device is lost.
 */
#ifndef PT_ASYNC_H
#define PT_ASYNC_H

#include <pt/pt.h>

#ifdef __cplusplus
extern "C" {
#endif

/** Begins to add samples to every pixel, and waits for none of them.
 *
 * Returns PT_PENDING where they are under way now, to be polled. PT_TARGET_REACHED: the image is good enough already,
 * and nothing is under way. All kernels that the samples may need are built here (pt_prepare builds most of them
 * ahead), and if the image has a number of samples at which a target error is checked, that is done first.
 *
 * One thread at a time per context. Fails as pt_accumulate does, and with PT_ERROR_INVALID_ARGUMENT where info.progress
 * is not NULL. */
PT_API pt_result pt_start(pt_context *context, const pt_accumulate_info *info);

/** Takes in what devices have done since the last call, gives them more, and waits for them, for so many nanoseconds at
 * the most.
 *
 * With 0 it does not wait, with UINT64_MAX until all is done. It may take longer when a target error is checked,
 * which reads the image. It never builds a kernel: a scene that has been rendered for long enough to get one of its own
 * (PT_CREATE_NO_SCENE_KERNELS) gets it by the next pt_start.
 *
 * fraction may be NULL. Else it receives the share of the samples that is done, in [0, 1], which never falls, unless
 * the call fails.
 *
 * One thread at a time per context. PT_PENDING: samples are under way still. All other results end what pt_start began,
 * but for the refusal of a call from a callback or beside another thread's. PT_OK: all samples are taken.
 * PT_TARGET_REACHED: fewer were enough. PT_CANCELLED: pt_cancel was called, and there are fewer samples than asked for,
 * all of them whole. PT_ERROR_INVALID_STATE: nothing is under way. PT_ERROR_OUT_OF_DEVICE_MEMORY, PT_ERROR_SHADER,
 * PT_ERROR_DEVICE_LOST: the driver said so. */
PT_API pt_result pt_poll(pt_context *context, uint64_t nanoseconds, double *fraction);

/** Asks for no more samples, and returns at once. pt_poll then ends what pt_start began, and a pt_accumulate under way
 * ends by itself, as after a pt_progress_fn that asks to stop: with PT_CANCELLED, or with PT_OK if no sample was left
 * to begin. A second call does nothing more.
 *
 * Any thread, at any time before pt_destroy, also in callbacks and while another thread is in a call on the context.
 * PT_ERROR_INVALID_STATE: nothing is under way, as may well happen beside a thread that polls. */
PT_API pt_result pt_cancel(pt_context *context);

#ifdef __cplusplus
}
#endif

#endif
