/** @file
 * Films of pt: the exact sums behind an image, as bytes to be kept, sent and added.
 *
 * A film that was saved and added again goes on to the same bits as one that was never interrupted, and parts of an image that
 * were rendered apart (pt_render.first_sample) add up, in any order, to the bits of one that was rendered whole: on the same
 * model of device with the same driver.
 */
#ifndef PT_FILM_H
#define PT_FILM_H

#include <pt/pt.h>

#ifdef __cplusplus
extern "C" {
#endif

/** Writes the samples so far as exact sums, with what decides their bits and a checksum.
 *
 * data == NULL: *size_bytes receives how many bytes that takes, up to 112 for each pixel and some hundred more. Else
 * *size_bytes is the size of data, which must suffice, and receives how many were written. Equal samples of equal
 * pictures are equal bytes, however they were taken or added. What the bytes are is told in lib/film/FORMAT.md, for other
 * programs to read them, and stays readable by later versions of this library.
 *
 * One thread at a time per context. PT_ERROR_INVALID_STATE: there is no sample. PT_ERROR_INVALID_ARGUMENT: size_bytes is
 * too small. PT_ERROR_DEVICE_LOST. After a failure *size_bytes is as before, and what data holds is undefined. */
PT_API pt_result pt_save_film(pt_context *context, void *data, uint64_t *size_bytes);

/** Adds the samples of a film that pt_save_film has written to those of the context.
 *
 * Needs the scene, camera and render settings with which the film was made, but for pt_render.first_sample. Later calls of
 * pt_accumulate take, from pt_render.first_sample on, the samples that are missing. With PT_SAMPLER_SOBOL the error that is
 * stated (pt_stats) was from 0.76 to 3.7 times the true one for samples that are not the first ones or have gaps.
 *
 * The bytes need not be trusted: they are checked as a whole before anything changes.
 *
 * One thread at a time per context. PT_ERROR_INCOMPATIBLE: they are no film, damaged, cut short, of another picture, or
 * have samples that the context has already; the message has a line for each difference. PT_ERROR_INVALID_STATE: something
 * is not set. PT_ERROR_OUT_OF_DEVICE_MEMORY: for the time of the call the sums are there twice, and there is no room.
 * PT_ERROR_DEVICE_LOST: the driver said so. */
PT_API pt_result pt_add_film(pt_context *context, const void *data, uint64_t size_bytes);

#ifdef __cplusplus
}
#endif

#endif
