/** @file
 * pt: radiance to pixels for displays and PNG files, by exposure, white point, tone curve and encoding.
 */
#ifndef PT_DISPLAY_H
#define PT_DISPLAY_H

#include <pt/pt.h>

#ifdef __cplusplus
extern "C" {
#endif

/** Values of pt_display_info.curve: radiance to light of a display, which is clamped to [0, 1]. */
enum {
    PT_CURVE_NONE = 0,     /**< unchanged */
    PT_CURVE_REINHARD = 1, /**< Reinhard et al. 2002, eq. 3, on the luminance */
    PT_CURVE_ACES = 2,     /**< Narkowicz 2015 */
    PT_CURVE_AGX = 3,      /**< Sobotka 2022, base look */
    PT_CURVE_NEUTRAL = 4   /**< Khronos PBR Neutral 2024 */
};

/** Input and output of pt_display. Arrays have no gaps between pixels. */
typedef struct pt_display_info {
    uint32_t struct_size; /**< sizeof(pt_display_info) */
    uint32_t curve;       /**< PT_CURVE_* */
    uint32_t bits;        /**< bits of a component: 8 (uint8_t, default) or 16 (uint16_t in the machine's byte order) */
    /** if not 0, pt_automatic_exposure of these pixels replaces exposure, which must be 0 */
    uint32_t automatic_exposure;
    double exposure; /**< stops, in [-64, 64]; multiplies radiance by 2^exposure */
    double gamma;    /**< in [0.1, 10]: the signal is light^(1 / gamma); 0: the sRGB curve (IEC 61966-2-1) */
    /** R, G, B in [1e-3, 1e3], default (1, 1, 1). Light of this color is shown as grey of equal luminance (Rec.
     * 709). */
    double white[3];
    uint64_t pixel_count;  /**< may be 0 */
    const float *radiance; /**< linear R, G, B, multiplied by alpha; finite; negative numbers count as 0 */
    const float *alpha;    /**< one number in [0, 1] per pixel; NULL: opaque pixels */
    void *pixels;          /**< receives R, G, B or, with alpha, R, G, B, A; not multiplied by alpha; any alignment */
    uint64_t size_bytes;   /**< size of pixels; at least pixel_count * (3, or 4 with alpha) * bits / 8 */
} pt_display_info;

/** Makes pixels for a display. A component is its signal times 255 or 65535, rounded; halves round up. Alpha is linear.
 * Any thread. */
PT_API pt_result pt_display(const pt_display_info *info);

/** Finds the exposure that brings the average to middle grey, 0.18. The exposure is in stops, rounded to hundredths, in
 * [-64, 64].
 *
 * The average is the exponential of the mean logarithm (Reinhard, Stark, Shirley, Ferwerda 2002, eqs. 1 and 2) of the
 * pixels' channel means. Pixels below 1/128 of the picture's mean have less weight. The exposure of black pixels is 0.
 *
 * radiance is as in pt_display_info, or NULL if pixel_count is 0. Any thread. */
PT_API pt_result pt_automatic_exposure(const float *radiance, uint64_t pixel_count, double *exposure);

#ifdef __cplusplus
}
#endif

#endif
