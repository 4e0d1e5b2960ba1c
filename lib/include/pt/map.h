/** @file
 * pt: images in the library's own memory, for programs that want each image as soon as possible.
 *
 * For images of a megabyte or more, pt_readback spends most of its time copying pixels into the caller's memory. A
 * program that reads them once, to encode, send or show them, can do so in place. */
#ifndef PT_MAP_H
#define PT_MAP_H

#include <pt/pt.h>

#ifdef __cplusplus
extern "C" {
#endif

/** Makes an image as pt_readback does, with the same bits, and leaves it in the library's memory.
 *
 * image is as for pt_readback, except that data, size_bytes and row_bytes must be 0. *data receives the address of the
 * pixels, a multiple of 16; they are row by row from the top, without gaps. size_bytes may be NULL; otherwise
 * *size_bytes receives their size. The context owns them: the caller frees nothing, and may read and write the pixels
 * until the next pt_map_image, pt_set_render, pt_reload_shaders or pt_destroy on the context, also while samples are
 * under way (pt/async.h).
 *
 * One thread at a time per context; any thread may read the pixels. Fails as pt_readback does, with
 * PT_ERROR_OUT_OF_DEVICE_MEMORY or PT_ERROR_OUT_OF_HOST_MEMORY if there is no memory for the image, and with
 * PT_ERROR_INVALID_ARGUMENT if data is NULL. After a failure *data and *size_bytes are as before. */
PT_API pt_result pt_map_image(pt_context *context, const pt_image *image, void **data, uint64_t *size_bytes);

#ifdef __cplusplus
}
#endif

#endif
