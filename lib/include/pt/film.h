/** @file
 * pt: films, the exact sums behind an image, as bytes that can be stored, sent and added.
 *
 * On one model of device and driver, a rendering continued from a saved film has the bits of an uninterrupted one.
 * Parts rendered separately (pt_render.first_sample) add up, in any order, to the bits of the whole. */
#ifndef PT_FILM_H
#define PT_FILM_H

#include <pt/pt.h>
#include <pt/stats.h>

#ifdef __cplusplus
extern "C" {
#endif

/** Writes the samples so far as exact sums, with everything that determines their bits, and a checksum.
 *
 * If data is NULL, *size_bytes receives the film's size, at most 112 bytes a pixel (116 with PT_RENDER_COVERAGE) and
 * some hundred more. Otherwise *size_bytes is the size of data, and receives the number of bytes written. Equal samples
 * of equal pictures give equal bytes. lib/film/FORMAT.md describes the bytes. Later versions of this library can read
 * them.
 *
 * One thread at a time. PT_ERROR_INVALID_STATE: there is no sample. PT_ERROR_INVALID_ARGUMENT: *size_bytes is too
 * small. After a failure *size_bytes is unchanged, and data is undefined. */
PT_API pt_result pt_save_film(pt_context *context, void *data, uint64_t *size_bytes);

/** Adds a saved film's samples to the context's samples.
 *
 * The context must have the film's scene, camera and render settings, except pt_render.first_sample. Later calls of
 * pt_accumulate take the missing samples from pt_render.first_sample on. With PT_SAMPLER_SOBOL, if the samples have
 * gaps or are not the first ones, pt_get_error_estimate states 0.76 to 3.7 times the true error.
 *
 * The bytes need not be trusted: they are checked before anything changes.
 *
 * One thread at a time. PT_ERROR_INCOMPATIBLE: the bytes are not a film, are damaged, belong to another picture, or
 * have samples that the context already has. The message has a line for each difference. PT_ERROR_INVALID_STATE: scene,
 * camera or render settings are missing. PT_ERROR_OUT_OF_DEVICE_MEMORY: the device has no room for a second copy of the
 * sums. */
PT_API pt_result pt_add_film(pt_context *context, const void *data, uint64_t size_bytes);

/* ---- Films without a context ------------------------------------------------------------------------------------ */

/** A film in memory, which can be read and added without a device and the scene.
 *
 * The caller owns it from pt_open_film to pt_close_film. Only one thread at a time may use a film. */
typedef struct pt_film pt_film;

/** The picture of a film, and the rectangle of it that the film has. */
typedef struct pt_film_info {
    uint32_t struct_size;     /**< sizeof(pt_film_info) */
    uint32_t width;           /**< the whole image's width, pixels */
    uint32_t height;          /**< the whole image's height, pixels */
    uint32_t x;               /**< first column of the smallest rectangle of the image with all pixels of the film */
    uint32_t y;               /**< the rectangle's first row */
    uint32_t columns;         /**< the rectangle's width, pixels */
    uint32_t rows;            /**< the rectangle's height, pixels */
    uint32_t max_path_length; /**< as in pt_render */
    uint64_t seed;            /**< as in pt_render */
    uint32_t estimator;       /**< PT_ESTIMATOR_*, never BEST */
    uint32_t sampler;         /**< PT_SAMPLER_*, never BEST */
    uint32_t tile_count;      /**< rectangles of pixels with the same samples; 1 if all pixels have the same */
    /** A target error is reached only if every pixel has this many samples, which are expected to hit all lamps in view
     * smaller than a pixel. 0: there are no such lamps. */
    uint32_t lamp_sample_count;
    const char *device; /**< models and drivers of the devices that took the samples; ASCII, owned by the film */
    uint32_t flags;     /**< as in pt_render: PT_RENDER_COVERAGE if the film has coverage */
    uint32_t reserved;  /**< 0 */
} pt_film_info;

/** A rectangle of the image whose pixels have the same samples. */
typedef struct pt_film_tile {
    uint32_t struct_size; /**< sizeof(pt_film_tile) */
    uint32_t x;           /**< first column, in the image */
    uint32_t y;           /**< first row, in the image */
    uint32_t width;       /**< pixels, >= 1 */
    uint32_t height;      /**< pixels, >= 1 */
    uint32_t range_count; /**< ranges that pt_get_film_ranges writes for the tile; >= 1 */
} pt_film_tile;

/** The samples with indices from first to end - 1. The struct is an element of arrays and gains no fields. */
typedef struct pt_sample_range {
    uint64_t first; /**< index of the first sample */
    uint64_t end;   /**< > first, <= 2^32 */
} pt_sample_range;

/** Opens a film from its bytes, which are copied and checked. It takes 112 bytes of memory a pixel, 116 with coverage.
 *
 * On success the caller owns the film and frees it by pt_close_film. On failure *film is NULL. Any thread.
 * PT_ERROR_INCOMPATIBLE: the bytes are not a film, or are damaged. */
PT_API pt_result pt_open_film(const void *data, uint64_t size_bytes, pt_film **film);

/** Frees a film. NULL is allowed. One thread, after all other calls on the film; never fails. */
PT_API void pt_close_film(pt_film *film);

/** Adds the samples of another film, given as bytes. It may have other pixels of the image. Films add up to the same
 * bits in any order. One thread at a time. PT_ERROR_INCOMPATIBLE: the bytes are not a film, are damaged, belong to
 * another picture, or have samples that a pixel of the film already has. */
PT_API pt_result pt_merge_film(pt_film *film, const void *data, uint64_t size_bytes);

/** Writes the same bytes as pt_save_film for a context with the same samples. data and *size_bytes are as for
 * pt_save_film.
 *
 * One thread at a time. PT_ERROR_INVALID_ARGUMENT: *size_bytes is too small; it stays unchanged. */
PT_API pt_result pt_write_film(const pt_film *film, void *data, uint64_t *size_bytes);

/** Receives the next bytes of a film, valid until it returns. Return 0 to go on. Any other value ends pt_stream_film.
 * user is the argument of pt_stream_film. */
typedef int32_t (*pt_take_bytes_fn)(void *user, const void *data, uint64_t size_bytes);

/** Passes the bytes of pt_write_film to take, in order and in pieces of at most a megabyte. take must not call any
 * function on this film. One thread at a time. PT_CANCELLED: take ended the call. */
PT_API pt_result pt_stream_film(const pt_film *film, pt_take_bytes_fn take, void *user);

/** Writes mean radiance, its standard error, the counts of samples or coverage, with the bits of pt_readback for the
 * same samples.
 *
 * The image is the rectangle of pt_film_info, so pt_image.x counts from its first column and pt_image.y from its first
 * row. Pixels that the film lacks are black, with a standard error of INFINITY. One thread at a time.
 * PT_ERROR_INVALID_ARGUMENT: the image asks for first hits, or for coverage of a film without it. */
PT_API pt_result pt_read_film(const pt_film *film, const pt_image *image);

/** Describes a film. One thread at a time. */
PT_API pt_result pt_get_film_info(const pt_film *film, pt_film_info *info);

/** Writes the tile with an index below pt_film_info.tile_count.
 *
 * Tiles do not overlap. Equal samples of equal pixels give equal tiles. One thread at a time. */
PT_API pt_result pt_get_film_tile(const pt_film *film, uint32_t index, pt_film_tile *tile);

/** Lists the samples of a tile's pixels, as ranges in ascending order with gaps between them. One thread at a time. */
PT_API pt_result pt_get_film_ranges(const pt_film *film, uint32_t tile, pt_sample_range *ranges, uint32_t *count);

/** Writes a film's numbers of samples.
 *
 * sample_count is the fewest of a pixel in the rectangle of pt_film_info, 0 if the film lacks a pixel there.
 * max_sample_count, mean_sample_count and rejected_samples are as for a context. All other fields are 0. One thread at
 * a time. */
PT_API pt_result pt_get_film_stats(const pt_film *film, pt_stats *stats);

/** Estimates the error of a film's image, as pt_get_error_estimate does for a context. The last bits may differ.
 *
 * The smallest number of a pixel's samples determines the stated unseen light. A film does not know the scene's lamps.
 * So PT_UNCERTAIN_UNMET is set whenever the estimator finds lamps by chance (uniform, cosine, bsdf) and max_path_length
 * is above 1. One thread at a time. */
PT_API pt_result pt_get_film_error_estimate(const pt_film *film, pt_error_estimate *error);

/** Decides which samples a film needs next to reach a target error, as pt_accumulate does with PT_SAMPLING_ADAPTIVE.
 * Other machines can then take these samples (pt_accumulate_info.tile_samples).
 *
 * The film must have all pixels of an image, or of whole rows of one, with a first row that is a multiple of 8. Tiles
 * are the squares of 8 x 8 pixels of pt_accumulate_info.
 * - target_error: > 0 and finite
 * - most: the most samples that a pixel may have
 * - goals: receives for each tile how many samples its pixels need, never fewer than they have. If goals is NULL,
 *   *count receives the number of tiles. Otherwise *count must be the number of tiles.
 *
 * Decisions depend only on the samples and stay in the film. Later calls on the film, or on a saved copy, continue from
 * there. A context on a CPU with the same limit gets the same film; on a GPU it gets another one.
 *
 * PT_PENDING: some tiles need more samples. PT_TARGET_REACHED: the film has the target error. PT_OK: the film does not
 * have the target error, and every tile that needs more samples has the most allowed.
 *
 * One thread at a time. PT_ERROR_INCOMPATIBLE: the film's tiles cannot be made of such squares. */
PT_API pt_result pt_plan_film(pt_film *film, double target_error, uint32_t most, uint32_t *goals, uint32_t *count);

#ifdef __cplusplus
}
#endif

#endif
