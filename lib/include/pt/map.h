/** @file
 * pt: images in memory of the library's, for programs that want each as soon as it is there.
 *
 * For images of a megabyte or more, pt_readback spends most of its time copying pixels from memory that the device has
 * written to the caller's. Whoever reads them once, to encode, send or show them, can do so in place.
 */
#ifndef PT_MAP_H
#define PT_MAP_H

#include <pt/pt.h>

#ifdef __cplusplus
extern "C" {
#endif

/** Makes an image as pt_readback does, with the same bits, and leaves it in memory of the library's.
 *
 * image says what is read, as for pt_readback; its data, size_bytes and row_bytes must be 0. *data receives the address
 * of the pixels, row by row from the top and without gaps, a multiple of 16, and *size_bytes, which may be NULL, their
 * size. They are the context's: the caller may read and write them until the next pt_map_image, pt_set_render,
 * pt_reload_shaders or pt_destroy of the context, while samples are under way too (pt/async.h), and frees nothing. The
 * memory is kept for the next image.
 *
 * One thread at a time per context; the pixels may be read by any. Fails as pt_readback does, with
 * PT_ERROR_OUT_OF_DEVICE_MEMORY or PT_ERROR_OUT_OF_HOST_MEMORY where there is no memory for the image, and with
 * PT_ERROR_INVALID_ARGUMENT where data is NULL; *data and *size_bytes stay as they are then. */
PT_API pt_result pt_map_image(pt_context *context, const pt_image *image, void **data, uint64_t *size_bytes);

#ifdef __cplusplus
}
#endif

#endif
