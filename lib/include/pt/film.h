/** @file
 * Films of pt: the exact sums behind an image, as bytes to be kept, sent and added.
 *
 * A film that was saved and added again goes on to the same bits as one that was never interrupted, and parts of an
 * image that were rendered apart (pt_render.first_sample) add up, in any order, to the bits of one that was rendered
 * whole: on the same model of device with the same driver.
 */
#ifndef PT_FILM_H
#define PT_FILM_H

#include <pt/pt.h>
#include <pt/stats.h>

#ifdef __cplusplus
extern "C" {
#endif

/** Writes the samples so far as exact sums, with what decides their bits and a checksum.
 *
 * data == NULL: *size_bytes receives how many bytes that takes, up to 112 for each pixel and some hundred more. Else
 * *size_bytes is the size of data, which must suffice, and receives how many were written. Equal samples of equal
 * pictures are equal bytes, however they were taken or added. What the bytes are is told in lib/film/FORMAT.md, for
 * other programs to read them, and stays readable by later versions of this library.
 *
 * One thread at a time per context. PT_ERROR_INVALID_STATE: there is no sample. PT_ERROR_INVALID_ARGUMENT: size_bytes
 * is too small. PT_ERROR_DEVICE_LOST. After a failure *size_bytes is as before, and what data holds is undefined. */
PT_API pt_result pt_save_film(pt_context *context, void *data, uint64_t *size_bytes);

/** Adds the samples of a film that pt_save_film has written to those of the context.
 *
 * Needs the scene, camera and render settings with which the film was made, but for pt_render.first_sample. Later calls
 * of pt_accumulate take, from pt_render.first_sample on, the samples that are missing. With PT_SAMPLER_SOBOL the error
 * that is stated (pt_stats) was from 0.76 to 3.7 times the true one for samples that are not the first ones or have
 * gaps.
 *
 * The bytes need not be trusted: they are checked as a whole before anything changes.
 *
 * One thread at a time per context. PT_ERROR_INCOMPATIBLE: they are no film, damaged, cut short, of another picture, or
 * have samples that the context has already; the message has a line for each difference. PT_ERROR_INVALID_STATE:
 * something is not set. PT_ERROR_OUT_OF_DEVICE_MEMORY: for the time of the call the sums are there twice, and there is
 * no room. PT_ERROR_DEVICE_LOST: the driver said so. */
PT_API pt_result pt_add_film(pt_context *context, const void *data, uint64_t size_bytes);

/* ---- Films without a context ------------------------------------------------------------------------------------ */

/** A film in memory: to add films, and to see what they show, where there is neither a device nor the scene.
 *
 * Made by pt_open_film and owned by its caller until pt_close_film. Different films are independent; of one film, one
 * thread at a time is in a call. Failures leave their message to pt_last_error(NULL), as all calls without a context.
 */
typedef struct pt_film pt_film;

/** What a film is of. */
typedef struct pt_film_info {
    uint32_t struct_size;     /**< sizeof(pt_film_info); must be set by the caller */
    uint32_t width;           /**< of the whole image, pixels */
    uint32_t height;          /**< likewise */
    uint32_t x;               /**< of the smallest rectangle of the image with all pixels of the film: first column */
    uint32_t y;               /**< its first row */
    uint32_t columns;         /**< its width, pixels */
    uint32_t rows;            /**< its height, pixels */
    uint32_t max_path_length; /**< as in pt_render */
    uint64_t seed;            /**< as in pt_render */
    uint32_t estimator;       /**< PT_ESTIMATOR_*, not BEST but what that stands for */
    uint32_t sampler;         /**< PT_SAMPLER_*, likewise */
    uint32_t tile_count;      /**< tiles, each of pixels with the same samples; 1 where all pixels have */
    uint32_t reserved;        /**< 0 */
    /** models and drivers of the devices that took the samples; ASCII, owned by the film, valid until it is closed */
    const char *device;
} pt_film_info;

/** A rectangle of the image whose pixels have the same samples. */
typedef struct pt_film_tile {
    uint32_t struct_size; /**< sizeof(pt_film_tile); must be set by the caller */
    uint32_t x;           /**< first column, in the image */
    uint32_t y;           /**< first row */
    uint32_t width;       /**< pixels, >= 1 */
    uint32_t height;      /**< likewise */
    uint32_t range_count; /**< of its samples, for pt_get_film_ranges; >= 1 */
} pt_film_tile;

/** The samples with indices from first to end - 1. An element of arrays: frozen. */
typedef struct pt_sample_range {
    uint64_t first; /**< index of the first sample */
    uint64_t end;   /**< > first, <= 2^32 */
} pt_sample_range;

/** Opens a film that pt_save_film or pt_write_film has written. The bytes are copied, and need not be trusted: they are
 * checked as a whole.
 *
 * It takes 112 bytes for each pixel of the film. On success the film is the caller's, who ends it by pt_close_film; on
 * failure NULL is written. Any thread. PT_ERROR_INCOMPATIBLE: they are no film, damaged or cut short. */
PT_API pt_result pt_open_film(const void *data, uint64_t size_bytes, pt_film **film);

/** Frees a film. NULL is allowed. One thread, after all other calls on it; never fails. */
PT_API void pt_close_film(pt_film *film);

/** Adds the samples of a film that pt_save_film or pt_write_film has written, which may be of other pixels of the
 * image. In any order, films add up to the same bits.
 *
 * For the time of the call it takes as much memory as opening the other does, and a little. One thread at a time per
 * film. PT_ERROR_INCOMPATIBLE: the bytes are no film, damaged, cut short, of another picture, or have samples of some
 * pixel that are in the film already; the message has a line for each difference. */
PT_API pt_result pt_merge_film(pt_film *film, const void *data, uint64_t size_bytes);

/** Writes a film as bytes; data and *size_bytes are as with pt_save_film, and so are the bytes: a context that has
 * taken the same samples writes the same.
 *
 * One thread at a time per film. PT_ERROR_INVALID_ARGUMENT: size_bytes is too small; it stays as it was. */
PT_API pt_result pt_write_film(const pt_film *film, void *data, uint64_t *size_bytes);

/** Takes the next bytes of a film, which stay as they are until it returns. Called by the thread of the call that it
 * was given to. Return 0 to go on; anything else ends that call. */
typedef int32_t (*pt_take_bytes_fn)(void *user, const void *data, uint64_t size_bytes);

/** Hands on the bytes that pt_write_film writes, from the first to the last in pieces of at most a megabyte: so a film
 * is kept or sent without being in memory twice.
 *
 * take must not call anything with this film; user is for it. One thread at a time per film. PT_CANCELLED: take asked
 * to end it. */
PT_API pt_result pt_stream_film(const pt_film *film, pt_take_bytes_fn take, void *user);

/** Writes mean radiance, its standard error or the counts of samples, like pt_readback: the same bits that the context
 * shows which took the samples.
 *
 * The image is the rectangle that pt_film_info tells, so that pt_image.x counts from its first column and pt_image.y
 * from its first row. Pixels that the film does not have are black, with a standard error of INFINITY. One thread at a
 * time per film. PT_ERROR_INVALID_ARGUMENT: the image breaks a rule; of what camera rays meet first a film knows
 * nothing. */
PT_API pt_result pt_read_film(const pt_film *film, const pt_image *image);

/** Writes what a film is of. info->struct_size must be set; no more than that is written. One thread at a time per
 * film. */
PT_API pt_result pt_get_film_info(const pt_film *film, pt_film_info *info);

/** Writes a tile. index: below pt_film_info.tile_count. tile->struct_size must be set; no more than that is written.
 *
 * Tiles do not overlap, and the same samples of the same pixels are always the same tiles. One thread at a time per
 * film. PT_ERROR_INVALID_ARGUMENT: there is no such tile. */
PT_API pt_result pt_get_film_tile(const pt_film *film, uint32_t index, pt_film_tile *tile);

/** Writes which samples the pixels of a tile have, in ascending order and never adjacent.
 *
 * ranges == NULL: *count receives how many ranges there are. Else at most *count elements are written, and *count
 * receives how many. One thread at a time per film. PT_ERROR_INVALID_ARGUMENT: there is no such tile. */
PT_API pt_result pt_get_film_ranges(const pt_film *film, uint32_t tile, pt_sample_range *ranges, uint32_t *count);

/** Writes how many samples a film has: sample_count, in every pixel of the rectangle that pt_film_info tells, the
 * fewest if they differ, 0 if a pixel there has none; max_sample_count, mean_sample_count and rejected_samples as of a
 * context. All other fields are 0. stats->struct_size must be set; no more than that is written. One thread at a time
 * per film. */
PT_API pt_result pt_get_film_stats(const pt_film *film, pt_stats *stats);

/** Writes how good a film's image is, as pt_get_error_estimate says it of a context, but for last bits that depend on
 * the order of additions.
 *
 * Nothing is known if pt_stats.sample_count is below 16; where counts differ, light that no sample has met is told from
 * the least. A film does not know the scene's lamps, so PT_UNCERTAIN_UNMET stands wherever the estimator finds lamps by
 * chance (uniform, cosine, bsdf) and max_path_length is above 1. error->struct_size must be set; no more than that is
 * written. One thread at a time per film. */
PT_API pt_result pt_get_film_error_estimate(const pt_film *film, pt_error_estimate *error);

/** Says what a film takes next on its way to a target error, as pt_accumulate decides it with PT_SAMPLING_ADAPTIVE: so
 * one machine can decide, and others take the samples (pt_accumulate_info.tile_samples), however they share them.
 *
 * The film has all pixels of an image, or of whole rows of one from a multiple of 8 on. target_error is > 0 and finite,
 * most the samples that a pixel may have. goals == NULL: *count receives the number of tiles, squares of 8 x 8 pixels
 * as pt_accumulate_info has them. Else *count is how many elements goals has, which must be that number, and goals
 * receives for each tile how many samples its pixels are to have, no fewer than they have. What has been decided stays
 * in the film: later calls, on it or on what was saved of it, go on from there.
 *
 * PT_PENDING: there are tiles that are to take more. PT_TARGET_REACHED: the film has the target error. PT_OK: it has
 * not, and no tile may take more. The same samples give the same answers, whoever took them in whatever parts. On a CPU
 * a context with as many samples at the most comes to the same film; GPUs tell tiles apart later, and round otherwise.
 *
 * One thread at a time per film. PT_ERROR_INVALID_ARGUMENT: a rule is broken. PT_ERROR_INCOMPATIBLE: the film has tiles
 * that are no such squares together. */
PT_API pt_result pt_plan_film(pt_film *film, double target_error, uint32_t most, uint32_t *goals, uint32_t *count);

#ifdef __cplusplus
}
#endif

#endif
