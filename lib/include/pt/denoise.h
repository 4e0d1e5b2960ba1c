/** @file
 * pt: denoising by Open Image Denoise, with the error of the denoised picture.
 *
 * pt_denoise filters two images of one scene. The result lies between the mean of both and the filtered images
 * (shaders/README.md, section 11). Each value stays within the range that both images have in the 3 x 3 pixels about
 * it. The mean of a channel moves by at most its standard error. Values stay unfiltered where the expected error of 32
 * x 32 pixels would rise.
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
    uint32_t width;       /**< pixels, >= 1 */
    uint32_t height;      /**< pixels, >= 1; width * height <= 2^32 - 1 */
    /** 0: the CPU; else the default device of Open Image Denoise, which its environment variable OIDN_DEFAULT_DEVICE
     * can set. */
    uint32_t any_device;
    const float *first; /**< radiance: PT_QUANTITY_RADIANCE; finite */
    /** The radiance with another pt_render.seed. All else must be equal, also each pixel's number of samples. With two
     * parts of one sample sequence, the error would be too small. */
    const float *second;
    const float *albedo; /**< PT_QUANTITY_ALBEDO */
    const float *normal; /**< PT_QUANTITY_NORMAL */
    float *denoised;     /**< receives the picture; must differ from the other images */
    /** File of Open Image Denoise 2. NULL: the system's libOpenImageDenoise.so.2. The file of the first call stays
     * loaded. */
    const char *library;
} pt_denoise_info;

/** Denoises an image, and estimates the error of the denoised picture. Open Image Denoise starts threads.
 *
 * If q estimates the squared error and s is its standard error, the error is sqrt(q + 1.28 s), the bounds sqrt(q - 1.96
 * s) and sqrt(q + 1.96 s). If the error comes from fewer than 8 tiles of 8 x 8 pixels, it is uncertain
 * (PT_UNCERTAIN_RMSE, PT_UNCERTAIN_RELATIVE_RMSE), and the bounds are twice as wide.
 *
 * Any thread. PT_ERROR_UNSUPPORTED: Open Image Denoise is missing, has another version, or does not run on this
 * processor. */
PT_API pt_result pt_denoise(const pt_denoise_info *info, pt_error_estimate *error);

/** Renders both images up to sample_count samples per pixel. Returns 0, or another value to stop. */
typedef int32_t (*pt_round_fn)(void *user, uint32_t sample_count);

/** When pt_denoise_rounds ends. */
typedef struct pt_rounds_info {
    uint32_t struct_size;  /**< sizeof(pt_rounds_info) */
    uint32_t sample_count; /**< most samples per pixel of each image, >= 1 */
    pt_round_fn render;    /**< stores the images, or changes pt_denoise_info's pointers to them */
    void *render_user;     /**< argument of render */
    pt_stopping stopping;  /**< only the first round may exceed a limit */
} pt_rounds_info;

/** Calls pt_denoise after each round of rendering. If stopping has a rule, rounds end at 16, 24, 36, ...
 * samples per pixel, each 1.5 times the previous number. The last round is shorter if samples or time end first.
 *
 * Any thread. Returns PT_TARGET_REACHED, PT_LIMIT_REACHED, PT_CANCELLED if render stops, otherwise PT_OK. */
PT_API pt_result pt_denoise_rounds(const pt_rounds_info *rounds, const pt_denoise_info *info, pt_error_estimate *error);

#ifdef __cplusplus
}
#endif

#endif
