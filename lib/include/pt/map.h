/** @file
 * pt: images in the library's memory, without the copy that pt_readback makes. */
#ifndef PT_MAP_H
#define PT_MAP_H

#include <pt/pt.h>

#ifdef __cplusplus
extern "C" {
#endif

/** Makes an image in the library's memory, with the same bits as from pt_readback. image is as for pt_readback, but
 * data, size_bytes and row_bytes must be 0. *data receives the address of the pixels, a multiple of 16. The pixels are
 * row by row from the top, without gaps. *size_bytes receives their size; size_bytes may be NULL.
 *
 * The context owns the pixels. The caller may read and write them until the next pt_map_image, pt_set_render,
 * pt_reload_shaders or pt_destroy on the context, also while samples are being taken (pt/async.h). Any thread may read
 * them.
 *
 * One thread at a time. Fails as pt_readback does. After a failure *data and *size_bytes are unchanged. */
PT_API pt_result pt_map_image(pt_context *context, const pt_image *image, void **data, uint64_t *size_bytes);

#ifdef __cplusplus
}
#endif

#endif
