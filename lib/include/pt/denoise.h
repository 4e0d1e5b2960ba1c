/** @file
 * pt: a denoised picture that states its error, by Open Image Denoise.
 *
 * Two images A and B of one scene have different seeds and equally many samples. Each shows the error of a filter D
 * applied to the other: B is the limit plus noise independent of D(A). The picture lies between the raw image
 * (A + B) / 2 and the filtered one (D(A) + D(B)) / 2, where the error is least. It moves towards the latter only as far
 * as both images support:
 * - a value moves by at most 2 sqrt(2) |A - B| / 2, up to 16 times that where most of the 3x3 pixels about it differ
 *   more; equal values keep their mean,
 * - no value leaves the range of A and B within the 3x3 pixels about it,
 * - the mean of a channel moves by at most its standard error.
 */
#ifndef PT_DENOISE_H
#define PT_DENOISE_H

#include <pt/pt.h>
#include <pt/stats.h>

#ifdef __cplusplus
extern "C" {
#endif

/** Input and output of pt_denoise. Images are in PT_FORMAT_RGB32F, row by row from the top without gaps. */
typedef struct pt_denoise_info {
    uint32_t struct_size; /**< sizeof(pt_denoise_info) */
    uint32_t width;       /**< pixels of all images, >= 1 */
    uint32_t height;      /**< pixels, >= 1; width * height <= 2^32 - 1 */
    /** 0: the CPU; else a device that Open Image Denoise or its environment variable OIDN_DEFAULT_DEVICE ("cuda")
     * chooses */
    uint32_t any_device;
    const float *first; /**< radiance: PT_QUANTITY_RADIANCE; finite */
    /** the same with another pt_render.seed and all else equal, also each pixel's number of samples. Parts of one
     * sequence depend on each other: the stated error would be too small */
    const float *second;
    const float *albedo; /**< PT_QUANTITY_ALBEDO */
    const float *normal; /**< PT_QUANTITY_NORMAL */
    float *denoised;     /**< receives the picture; none of the others */
    /** File of Open Image Denoise 2; NULL: the system's libOpenImageDenoise.so.2. Stays loaded from the first call. */
    const char *library;
} pt_denoise_info;

/** Denoises an image, and estimates the result's error.
 *
 * On the CPU the result does not depend on the number of threads, which Open Image Denoise starts itself. Uses no
 * context.
 *
 * error receives the denoised picture's error; error->struct_size must be set. Squared errors have a standard error
 * from their spread over tiles of 8 x 8 pixels: rmse and relative_rmse are 1.28 of it above the estimate, bounds 1.96
 * to both sides. PT_UNCERTAIN_RMSE and PT_UNCERTAIN_RELATIVE_RMSE: the error comes from fewer than 8 such tiles, and
 * the upper bound is doubled. Light that no sample has met is not included.
 *
 * Any thread; pt_last_error(NULL) has the message of a failure. PT_ERROR_INVALID_ARGUMENT: a rule is broken.
 * PT_ERROR_UNSUPPORTED: the library is missing, of another version, or does not run on this processor. */
PT_API pt_result pt_denoise(const pt_denoise_info *info, pt_error_estimate *error);

#ifdef __cplusplus
}
#endif

#endif
