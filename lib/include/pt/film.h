/** @file
 * pt: films, the exact sums behind an image, as bytes that can be stored, sent and added.
 *
 * A rendering continued from a saved film has the bits of an uninterrupted one, if devices and drivers are the same.
 * Parts of the samples rendered separately (pt_render.first_sample) add up to the same bits in any order. */
#ifndef PT_FILM_H
#define PT_FILM_H

#include <pt/pt.h>
#include <pt/stats.h>

#ifdef __cplusplus
extern "C" {
#endif

/** Writes a film: the exact sums of the samples, everything that determines their bits, and a checksum.
 *
 * If data is NULL, *size_bytes receives the film's size, at most 112 bytes a pixel (116 with PT_RENDER_COVERAGE) and
 * some hundred more. Otherwise *size_bytes is the size of data, and receives the number of bytes written. Equal samples
 * give equal bytes. Later versions of this library can read the bytes (lib/film/FORMAT.md).
 *
 * One thread at a time. PT_ERROR_INVALID_STATE: there is no sample. PT_ERROR_INVALID_ARGUMENT: *size_bytes is too
 * small. After a failure *size_bytes is unchanged, and the contents of data are undefined. */
PT_API pt_result pt_save_film(pt_context *context, void *data, uint64_t *size_bytes);

/** Adds a saved film's samples to the context's samples.
 *
 * The context must have the film's scene, camera and render settings, except pt_render.first_sample. Later calls of
 * pt_accumulate take the missing samples from pt_render.first_sample on.
 *
 * The bytes may come from an untrusted source.
 *
 * One thread at a time. PT_ERROR_INCOMPATIBLE: the bytes are not a film, are damaged, belong to another picture, or
 * have samples that the context already has. The message has a line for each difference. */
PT_API pt_result pt_add_film(pt_context *context, const void *data, uint64_t size_bytes);

/* ---- Films without a context ------------------------------------------------------------------------------------ */

/** A film in memory. The caller owns it from pt_open_film to pt_close_film. */
typedef struct pt_film pt_film;

/** The picture of a film, and the smallest rectangle that contains the film's pixels. */
typedef struct pt_film_info {
    uint32_t struct_size;     /**< sizeof(pt_film_info) */
    uint32_t width;           /**< the whole image's width, pixels */
    uint32_t height;          /**< the whole image's height, pixels */
    uint32_t x;               /**< first column of the rectangle in the whole image */
    uint32_t y;               /**< the rectangle's first row */
    uint32_t columns;         /**< the rectangle's width, pixels */
    uint32_t rows;            /**< the rectangle's height, pixels */
    uint32_t max_path_length; /**< as in pt_render */
    uint64_t seed;            /**< as in pt_render */
    uint32_t estimator;       /**< PT_ESTIMATOR_*, never BEST */
    uint32_t sampler;         /**< PT_SAMPLER_*, never BEST */
    uint32_t tile_count;      /**< number of tiles; 1 if all pixels have the same samples */
    /** Number of samples of a pixel, enough to hit lamps in view that are smaller than a pixel. A target error is
     * reached only when every pixel has this number. 0: there are no such lamps. */
    uint32_t lamp_sample_count;
    const char *device; /**< devices and drivers that took the samples; ASCII, owned by the film */
    uint32_t flags;     /**< PT_RENDER_* */
    uint32_t reserved;  /**< 0 */
} pt_film_info;

/** A rectangle of pixels with the same samples. */
typedef struct pt_film_tile {
    uint32_t struct_size; /**< sizeof(pt_film_tile) */
    uint32_t x;           /**< first column in the whole image */
    uint32_t y;           /**< first row in the whole image */
    uint32_t width;       /**< pixels, >= 1 */
    uint32_t height;      /**< pixels, >= 1 */
    uint32_t range_count; /**< number of the tile's sample ranges; >= 1 */
} pt_film_tile;

/** The samples with indices first to end - 1. */
typedef struct pt_sample_range {
    uint64_t first; /**< index of the first sample */
    uint64_t end;   /**< > first, <= 2^32 */
} pt_sample_range;

/** Opens a film from its bytes, which are checked and copied. A film takes 112 bytes of memory a pixel, 116 with
 * coverage. On failure *film is NULL. Any thread. PT_ERROR_INCOMPATIBLE: the bytes are not a film, or are damaged. */
PT_API pt_result pt_open_film(const void *data, uint64_t size_bytes, pt_film **film);

/** Frees a film. NULL is allowed. One thread, after all other calls on the film; never fails. */
PT_API void pt_close_film(pt_film *film);

/** Adds the samples of another film, given as bytes. The other film may have other pixels of the image. One thread at a
 * time. PT_ERROR_INCOMPATIBLE: the bytes are not a film, are damaged, belong to another picture, or have samples that a
 * pixel of the film already has. */
PT_API pt_result pt_merge_film(pt_film *film, const void *data, uint64_t size_bytes);

/** Writes the bytes of a film. data, *size_bytes and errors are as for pt_save_film. One thread at a time. */
PT_API pt_result pt_write_film(const pt_film *film, void *data, uint64_t *size_bytes);

/** Receives the next bytes of a film. data is valid during the call. Return 0 to go on. Any other value ends
 * pt_stream_film. */
typedef int32_t (*pt_take_bytes_fn)(void *user, const void *data, uint64_t size_bytes);

/** Calls take with the bytes of pt_write_film, in order, in pieces of at most a megabyte. take must not call functions
 * on this film. One thread at a time. PT_CANCELLED: take ended the call. */
PT_API pt_result pt_stream_film(const pt_film *film, pt_take_bytes_fn take, void *user);

/** Writes radiance, standard error, sample counts or coverage, with the bits of pt_readback. The whole image is the
 * rectangle of pt_film_info, so pt_image.x and pt_image.y count from the rectangle's corner. Pixels that the film lacks
 * are black, with a standard error of INFINITY. One thread at a time. PT_ERROR_INVALID_ARGUMENT: another quantity is
 * read, or coverage that the film lacks. */
PT_API pt_result pt_read_film(const pt_film *film, const pt_image *image);

/** Describes a film. One thread at a time. */
PT_API pt_result pt_get_film_info(const pt_film *film, pt_film_info *info);

/** Writes a tile. index must be below pt_film_info.tile_count.
 *
 * One thread at a time. */
PT_API pt_result pt_get_film_tile(const pt_film *film, uint32_t index, pt_film_tile *tile);

/** Lists the ranges of samples that a tile's pixels have, in ascending order. One thread at a time. */
PT_API pt_result pt_get_film_ranges(const pt_film *film, uint32_t tile, pt_sample_range *ranges, uint32_t *count);

/** Writes the numbers of samples: sample_count, max_sample_count, mean_sample_count and rejected_samples, over the
 * rectangle of pt_film_info. All other fields become 0. One thread at a time. */
PT_API pt_result pt_get_film_stats(const pt_film *film, pt_stats *stats);

/** Estimates the error of a film's image, as pt_get_error_estimate does for a context. A film does not store the
 * scene's lamps, so PT_UNCERTAIN_UNMET is set whenever the estimator finds lamps by chance (uniform, cosine, bsdf) and
 * max_path_length is above 1. One thread at a time. */
PT_API pt_result pt_get_film_error_estimate(const pt_film *film, pt_error_estimate *error);

/** Decides which samples a film needs next to reach a target error, as pt_accumulate does with PT_SAMPLING_ADAPTIVE.
 * Other machines can then take these samples (pt_accumulate_info.tile_samples).
 *
 * The film must have whole rows of an image, from a row that is a multiple of 8. Tiles are as in pt_accumulate_info.
 * - target_error: > 0 and finite
 * - most: the largest number of samples of a pixel
 * - goals: receives the number of samples that the pixels of each tile need, at least what they have. If goals is NULL,
 *   *count receives the number of tiles. Otherwise *count must be the number of tiles.
 *
 * Decisions depend only on the samples. The film stores them, so a later call on the film or on a saved copy continues
 * from there.
 *
 * PT_PENDING: some tiles need more samples. PT_TARGET_REACHED: the film has the target error. PT_OK: the film does not
 * have the target error, but all tiles that need more samples already have `most`.
 *
 * One thread at a time. PT_ERROR_INCOMPATIBLE: pixels of one tile have different samples. */
PT_API pt_result pt_plan_film(pt_film *film, double target_error, uint32_t most, uint32_t *goals, uint32_t *count);

#ifdef __cplusplus
}
#endif

#endif
