/** @file
 * pt: a denoised picture that states its error, by Open Image Denoise.
 *
 * Two images A and B are made of one scene with other seeds and equally many samples each, so that each tells the error
 * of what a filter D makes of the other: B is the limit plus noise that D(A) knows nothing of. The picture lies between
 * the raw image (A + B) / 2 and the filtered one (D(A) + D(B)) / 2, where the error is least. It moves towards the
 * latter only as far as both images support:
 * - a value by no more than 2 sqrt(2) |A - B| / 2, which counts up to 16 times where most of the 3x3 pixels about it
 *   differ more; equal values keep their mean,
 * - to no value beyond those that A and B have within the 3x3 pixels about it,
 * - the mean of a channel by no more than its standard error.
 */
#ifndef PT_DENOISE_H
#define PT_DENOISE_H

#include <pt/pt.h>
#include <pt/stats.h>

#ifdef __cplusplus
extern "C" {
#endif

/** What is denoised. Images are R, G, B (x, y, z) as float32, row by row from the top without gaps, as pt_readback
 * writes them in PT_FORMAT_RGB32F. */
typedef struct pt_denoise_info {
    uint32_t struct_size; /**< sizeof(pt_denoise_info) */
    uint32_t width;       /**< pixels, >= 1, as of all images here */
    uint32_t height;      /**< pixels, >= 1; width * height <= 2^32 - 1 */
    /** 0: on the CPU; else where Open Image Denoise chooses, such as on a GPU, or where its environment variable
     * OIDN_DEFAULT_DEVICE says ("cuda") */
    uint32_t any_device;
    const float *first; /**< radiance: PT_QUANTITY_RADIANCE; finite */
    /** the same with another pt_render.seed and all else equal, the number of samples in each pixel too: two parts of
     * one sequence depend on each other, so that errors would be stated too small */
    const float *second;
    const float *albedo; /**< PT_QUANTITY_ALBEDO */
    const float *normal; /**< PT_QUANTITY_NORMAL */
    float *denoised;     /**< receives the picture; none of the others */
    /** File of Open Image Denoise 2; NULL: libOpenImageDenoise.so.2, where the system finds libraries. It is loaded by
     * the first call, and stays. */
    const char *library;
} pt_denoise_info;

/** Denoises an image, and says how good the result is.
 *
 * On the CPU the result is independent of the number of threads, which Open Image Denoise starts itself. Nothing is
 * taken from, or changed in, any context.
 *
 * error receives the error of the denoised picture, and error->struct_size must be set. Its squares are estimated with
 * a standard error, as tiles of 8 x 8 pixels differ: rmse and relative_rmse are 1.28 of these above the estimate,
 * bounds 1.96 to both sides. PT_UNCERTAIN_RMSE and PT_UNCERTAIN_RELATIVE_RMSE: what is known comes from fewer than 8
 * such tiles, and the upper bound is doubled. Light that no sample has met is not in it.
 *
 * Any thread; the message of a failure is that of pt_last_error(NULL). PT_ERROR_INVALID_ARGUMENT: a rule is broken.
 * PT_ERROR_UNSUPPORTED: the library is not there, is of another version, or does not run on this processor. */
PT_API pt_result pt_denoise(const pt_denoise_info *info, pt_error_estimate *error);

#ifdef __cplusplus
}
#endif

#endif
