/** @file
 * pt: films, the exact sums behind an image, as bytes that can be kept, sent and added.
 *
 * On one model of device and driver, a rendering continued from a saved film has the bits of an uninterrupted one, and
 * parts rendered apart (pt_render.first_sample) add up, in any order, to the bits of the whole. */
#ifndef PT_FILM_H
#define PT_FILM_H

#include <pt/pt.h>
#include <pt/stats.h>

#ifdef __cplusplus
extern "C" {
#endif

/** Writes the samples so far as exact sums, with everything that decides their bits, and a checksum.
 *
 * If data is NULL, *size_bytes receives the film's size, up to 112 bytes a pixel and some hundred more. Otherwise
 * *size_bytes is the size of data, which must suffice, and receives how many bytes were written. Equal samples of equal
 * pictures are equal bytes. lib/film/FORMAT.md describes the bytes; later versions of this library can read them.
 *
 * One thread at a time per context. PT_ERROR_INVALID_STATE: there is no sample. PT_ERROR_INVALID_ARGUMENT: *size_bytes
 * is too small. PT_ERROR_DEVICE_LOST. After a failure *size_bytes is as before, and data is undefined. */
PT_API pt_result pt_save_film(pt_context *context, void *data, uint64_t *size_bytes);

/** Adds a saved film's samples to the context's.
 *
 * Needs the scene, camera and render settings with which the film was made, except that pt_render.first_sample may
 * differ. Later calls of pt_accumulate take the samples that are missing from pt_render.first_sample on. With
 * PT_SAMPLER_SOBOL, and samples that are not the first ones or have gaps, pt_get_error_estimate states 0.76 to 3.7
 * times the true error.
 *
 * The bytes need not be trusted: they are checked before anything changes.
 *
 * One thread at a time per context. PT_ERROR_INCOMPATIBLE: the bytes are not a film, damaged, cut short, of another
 * picture, or have samples that the context has already; the message has a line for each difference.
 * PT_ERROR_INVALID_STATE: something is not set. PT_ERROR_OUT_OF_DEVICE_MEMORY: there is no room for the sums twice.
 * PT_ERROR_DEVICE_LOST: the driver said so. */
PT_API pt_result pt_add_film(pt_context *context, const void *data, uint64_t size_bytes);

/* ---- Films without a context ------------------------------------------------------------------------------------ */

/** A film in memory, for adding and reading films without a device or the scene.
 *
 * Made by pt_open_film and owned by its caller until pt_close_film. Different films are independent; one film is used
 * by one thread at a time. Messages of failures are in pt_last_error(NULL), as for all calls without a context. */
typedef struct pt_film pt_film;

/** The picture that a film belongs to, and its part of it. */
typedef struct pt_film_info {
    uint32_t struct_size;     /**< sizeof(pt_film_info); must be set by the caller */
    uint32_t width;           /**< the whole image's width, pixels */
    uint32_t height;          /**< likewise */
    uint32_t x;               /**< first column of the smallest rectangle of the image with all pixels of the film */
    uint32_t y;               /**< its first row */
    uint32_t columns;         /**< its width, pixels */
    uint32_t rows;            /**< its height, pixels */
    uint32_t max_path_length; /**< as in pt_render */
    uint64_t seed;            /**< as in pt_render */
    uint32_t estimator;       /**< PT_ESTIMATOR_*, never BEST */
    uint32_t sampler;         /**< PT_SAMPLER_*, never BEST */
    uint32_t tile_count;      /**< rectangles of pixels with the same samples; 1 if all pixels have the same */
    /** fewest samples of a pixel with which a target error is reached: they are expected to meet all lamps in view
     * smaller than a pixel. 0: there are none */
    uint32_t lamp_sample_count;
    /** models and drivers of the devices that took the samples; ASCII, owned by the film */
    const char *device;
} pt_film_info;

/** A rectangle of the image whose pixels have the same samples. */
typedef struct pt_film_tile {
    uint32_t struct_size; /**< sizeof(pt_film_tile); must be set by the caller */
    uint32_t x;           /**< first column, in the image */
    uint32_t y;           /**< first row */
    uint32_t width;       /**< pixels, >= 1 */
    uint32_t height;      /**< likewise */
    uint32_t range_count; /**< ranges that pt_get_film_ranges writes for the tile; >= 1 */
} pt_film_tile;

/** The samples with indices from first to end - 1. Arrays hold it, so later versions add no fields. */
typedef struct pt_sample_range {
    uint64_t first; /**< index of the first sample */
    uint64_t end;   /**< > first, <= 2^32 */
} pt_sample_range;

/** Opens a film from the bytes of pt_save_film, pt_write_film or pt_stream_film. They are copied and checked, so need
 * not be trusted.
 *
 * The film takes 112 bytes of memory a pixel. On success the caller owns it and frees it by pt_close_film; on failure
 * *film is NULL. Any thread. PT_ERROR_INCOMPATIBLE: the bytes are not a film, damaged or cut short. */
PT_API pt_result pt_open_film(const void *data, uint64_t size_bytes, pt_film **film);

/** Frees a film. NULL is allowed. One thread, after all other calls on it; never fails. */
PT_API void pt_close_film(pt_film *film);

/** Adds the samples of a film, given as bytes as for pt_open_film; it may have other pixels of the image. Films add up
 * to the same bits in any order.
 *
 * Takes a little more memory than opening the other film. One thread at a time per film. PT_ERROR_INCOMPATIBLE: the
 * bytes are not a film, damaged, cut short, of another picture, or have samples of some pixel that are in the film
 * already; the message has a line for each difference. */
PT_API pt_result pt_merge_film(pt_film *film, const void *data, uint64_t size_bytes);

/** Writes a film as bytes, the same as pt_save_film for a context with the same samples. data and *size_bytes are as
 * there.
 *
 * One thread at a time per film. PT_ERROR_INVALID_ARGUMENT: *size_bytes is too small; it stays as it was. */
PT_API pt_result pt_write_film(const pt_film *film, void *data, uint64_t *size_bytes);

/** Receives the next bytes of a film, valid until it returns. Called within pt_stream_film, on its thread. Return 0
 * to go on; anything else ends pt_stream_film. */
typedef int32_t (*pt_take_bytes_fn)(void *user, const void *data, uint64_t size_bytes);

/** Hands the bytes of pt_write_film to take, in order and in pieces of at most a megabyte, so that a film is not in
 * memory twice.
 *
 * take must not call any function on this film; user is handed to it. One thread at a time per film. PT_CANCELLED: take
 * asked to end it. */
PT_API pt_result pt_stream_film(const pt_film *film, pt_take_bytes_fn take, void *user);

/** Writes mean radiance, its standard error or the counts of samples: the same bits as pt_readback of a context with
 * the same samples.
 *
 * The image is the rectangle in pt_film_info, so pt_image.x counts from its first column and pt_image.y from its first
 * row. Pixels that the film lacks are black, with a standard error of INFINITY. One thread at a time per film.
 * PT_ERROR_INVALID_ARGUMENT: the image breaks a rule, for instance asks for first hits, which a film does not know. */
PT_API pt_result pt_read_film(const pt_film *film, const pt_image *image);

/** Describes a film. info->struct_size must be set; no more bytes than that are written. One thread at a time per
 * film. */
PT_API pt_result pt_get_film_info(const pt_film *film, pt_film_info *info);

/** Writes a tile. index must be below pt_film_info.tile_count. tile->struct_size must be set; no more bytes than that
 * are written.
 *
 * Tiles do not overlap; equal samples of equal pixels give equal tiles. One thread at a time per film.
 * PT_ERROR_INVALID_ARGUMENT: there is no such tile. */
PT_API pt_result pt_get_film_tile(const pt_film *film, uint32_t index, pt_film_tile *tile);

/** Writes the samples of a tile's pixels, as ranges in ascending order with gaps between them.
 *
 * If ranges is NULL, *count receives how many ranges there are. Otherwise at most *count elements are written, and
 * *count receives how many were. One thread at a time per film. PT_ERROR_INVALID_ARGUMENT: there is no such tile. */
PT_API pt_result pt_get_film_ranges(const pt_film *film, uint32_t tile, pt_sample_range *ranges, uint32_t *count);

/** Writes a film's numbers of samples. sample_count is the fewest that a pixel of the rectangle in pt_film_info has,
 * 0 if a pixel there has none; max_sample_count, mean_sample_count and rejected_samples are as for a context; all
 * other fields are 0. stats->struct_size must be set; no more bytes than that are written. One thread at a time per
 * film. */
PT_API pt_result pt_get_film_stats(const pt_film *film, pt_stats *stats);

/** Estimates the error of a film's image, as pt_get_error_estimate does for a context; the last bits may differ, since
 * they depend on the order of additions.
 *
 * Nothing is known if pt_stats.sample_count is below 16. If counts differ, the smallest one decides the stated unseen
 * light. A film does not know the scene's lamps, so PT_UNCERTAIN_UNMET is set whenever the estimator finds lamps by
 * chance (uniform, cosine, bsdf) and max_path_length is above 1. error->struct_size must be set; no more bytes than
 * that are written. One thread at a time per film. */
PT_API pt_result pt_get_film_error_estimate(const pt_film *film, pt_error_estimate *error);

/** Decides which samples a film takes next on its way to a target error, as pt_accumulate does with
 * PT_SAMPLING_ADAPTIVE. So one machine can decide, and others take the samples (pt_accumulate_info.tile_samples).
 *
 * The film must have all pixels of an image, or of whole rows of one, the first row a multiple of 8. target_error must
 * be > 0 and finite; most is the number of samples that a pixel may have. If goals is NULL, *count receives the number
 * of tiles, which are squares of 8 x 8 pixels as in pt_accumulate_info. Otherwise *count is the number of elements of
 * goals and must be the number of tiles, and goals receives for each tile how many samples its pixels are to have,
 * never fewer than they have already. Decisions stay in the film: later calls on it, or on a saved copy, continue from
 * there.
 *
 * PT_PENDING: some tiles are to take more. PT_TARGET_REACHED: the film has the target error. PT_OK: it has not, and no
 * tile that needs more may take more. Answers depend on the samples alone. A context on a CPU with the same limit gets
 * the same film; on a GPU, tiles begin to differ at a later number of samples, and rounding differs.
 *
 * One thread at a time per film. PT_ERROR_INVALID_ARGUMENT: a rule is broken. PT_ERROR_INCOMPATIBLE: the film's tiles
 * cannot be made of such squares. */
PT_API pt_result pt_plan_film(pt_film *film, double target_error, uint32_t most, uint32_t *goals, uint32_t *count);

#ifdef __cplusplus
}
#endif

#endif
