/** @file
 * pt: a denoised picture that states its error, by Open Image Denoise.
 *
 * Two images of one scene have different seeds and equally many samples. pt_denoise filters each and moves their mean
 * towards the filtered images, as far as both images support (shaders/README.md, section 11). No value leaves the range
 * of both images within the 3x3 pixels about it. The mean of a channel moves by at most its standard error.
 * Values stay raw where the expected error of 32x32 pixels would grow.
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
    /** 0: the CPU. Otherwise Open Image Denoise or its environment variable OIDN_DEFAULT_DEVICE ("cuda") chooses a
     * device. */
    uint32_t any_device;
    const float *first; /**< radiance: PT_QUANTITY_RADIANCE; finite */
    /** The radiance with another pt_render.seed. All else must be equal, also each pixel's number of samples. With
     * parts of one sequence the stated error would be too small. */
    const float *second;
    const float *albedo; /**< PT_QUANTITY_ALBEDO */
    const float *normal; /**< PT_QUANTITY_NORMAL */
    float *denoised;     /**< receives the picture; must differ from the other images */
    /** File of Open Image Denoise 2. NULL: the system's libOpenImageDenoise.so.2. It stays loaded from the first
     * call. */
    const char *library;
} pt_denoise_info;

/** Denoises an image, and estimates the error of the denoised picture.
 *
 * On the CPU the result does not depend on the number of threads, which Open Image Denoise starts.
 *
 * The estimate of the squared error has a standard error, from the spread over tiles of 8 x 8 pixels. rmse and
 * relative_rmse lie 1.28 standard errors above the estimate, the bounds 1.96 below and above it. If the error comes
 * from fewer than 8 tiles, it is uncertain (PT_UNCERTAIN_RMSE, PT_UNCERTAIN_RELATIVE_RMSE), and the bounds
 * are twice as wide. Light that no sample has found is not included.
 *
 * Any thread. PT_ERROR_UNSUPPORTED: the library is missing, has another version, or does not run on this processor. */
PT_API pt_result pt_denoise(const pt_denoise_info *info, pt_error_estimate *error);

#ifdef __cplusplus
}
#endif

#endif
