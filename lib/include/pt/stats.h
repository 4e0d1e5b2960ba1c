/** @file
 * pt: statistics of the work done, and the image's error. */
#ifndef PT_STATS_H
#define PT_STATS_H

#include <pt/pt.h>

#ifdef __cplusplus
extern "C" {
#endif

/** Bits of pt_stats.features: parts of the kernel that the scene needs. */
enum {
    PT_FEATURE_LAMPS = 1,  /**< emitting spheres, sampled directly */
    PT_FEATURE_GLOSS = 2,  /**< specular lobes */
    PT_FEATURE_MOTION = 4, /**< spheres that move while the shutter is open */
    PT_FEATURE_LARGE = 8,  /**< more surfaces than a uniform buffer holds, or a tree */
    /** a tree over the spheres, if there are at least 113. The tree rounds centers by up to 2^-30 of the extent of its
     * spheres. */
    PT_FEATURE_TREE = 16,
    PT_FEATURE_ORTHOGRAPHIC = 32, /**< parallel camera rays */
    PT_FEATURE_HIDDEN = 64,       /**< surfaces that the camera does not see */
    PT_FEATURE_LENS = 128,        /**< camera rays start on a lens */
    PT_FEATURE_CAPSULES = 256,    /**< capsules (pt_sphere_array.end) */
    PT_FEATURE_OPACITY = 512      /**< translucent spheres (pt_sphere_array.opacity) */
};

/** Statistics of a context or a film. */
typedef struct pt_stats {
    uint32_t struct_size;      /**< sizeof(pt_stats) */
    uint32_t sample_count;     /**< complete samples of a pixel; the fewest if pixels differ */
    uint64_t rejected_samples; /**< samples of all pixels that were left out: NaN, infinite, negative or too bright */
    uint64_t device_bytes;     /**< memory that the context now has on all its devices */
    uint64_t submit_count;     /**< submissions with samples since pt_create, to all devices */
    double device_seconds;     /**< total time of these submissions */
    uint32_t features;         /**< PT_FEATURE_*; 0 before the first pt_accumulate */
    uint32_t device_count;     /**< devices of the context */
    uint32_t max_sample_count; /**< most samples of a pixel (PT_SAMPLING_ADAPTIVE) */
    uint32_t reserved;         /**< 0 */
    double mean_sample_count;  /**< mean over all pixels */
} pt_stats;

/** Bits of pt_error_estimate.uncertain: why a stated error may be far off. The bounds are then wider by a factor of
 * two. Small lamps in view are an exception: they raise only the error and its upper bound. */
enum {
    PT_UNCERTAIN_RMSE = 1, /**< rmse comes from fewer than 4 pixels: rare bright samples, or a small lamp */
    /** relative_rmse comes from fewer than 4 pixels, or from light that only single samples have found. */
    PT_UNCERTAIN_RELATIVE_RMSE = 2,
    /** more than a tenth of the square of relative_rmse is expected from light that no sample has found, in dark pixels
     * beside very bright ones. */
    PT_UNCERTAIN_UNSEEN = 4,
    /** samples may have missed lamps in one of two ways.
     * - Lamps in view are hit by less than half of a pixel's samples, because the lamps are small, move, are out of
     *   focus or shine through translucent spheres. Fewer than 6 samples are expected to have hit them, and the error
     *   computed from their sizes is larger than the samples show.
     * - Lamps (uniform, cosine, bsdf) or lobes (uniform, cosine) are found by chance, and fewer than a thousand samples
     *   of all pixels have hit an important lamp or lobe. */
    PT_UNCERTAIN_UNMET = 8
};

/** The image's error, estimated without a reference (shaders/README.md, section 11).
 *
 * rmse = sqrt(mean of (x - r)^2) over pixels and channels, where r is the limit of the image x. relative_rmse =
 * sqrt(mean of (x - r)^2 / (r^2 + 0.01)). The bounds hold with 95% confidence. Light that no sample has found is not
 * included, except small lamps in view.
 *
 * With fewer than 16 samples, or if more than one sample in 2^20 was left out, the error is unknown: lower bounds are
 * 0, the other values INFINITY. */
typedef struct pt_error_estimate {
    uint32_t struct_size;      /**< sizeof(pt_error_estimate) */
    uint32_t uncertain;        /**< PT_UNCERTAIN_*; 0 with fewer than 16 samples */
    double rmse;               /**< root mean square error, in units of radiance */
    double rmse_low;           /**< lower bound of rmse */
    double rmse_high;          /**< upper bound of rmse */
    double relative_rmse;      /**< relative root mean square error */
    double relative_rmse_low;  /**< lower bound of relative_rmse */
    double relative_rmse_high; /**< upper bound of relative_rmse */
} pt_error_estimate;

/** Returns the next number of samples above sample_count at which a target error is checked: 16, 20, 24, 28, 32, 40,
 * 48, 56, 64, 80, ..., in steps of a quarter of a power of two. UINT32_MAX after the last one. Any thread; never
 * fails. */
PT_API uint32_t pt_next_check(uint32_t sample_count);

/** Writes the statistics, also of a lost device. One thread at a time. */
PT_API pt_result pt_get_stats(pt_context *context, pt_stats *stats);

/** Estimates the image's error.
 *
 * Without render settings, or with a lost device, the error is unknown. One thread at a time. */
PT_API pt_result pt_get_error_estimate(pt_context *context, pt_error_estimate *error);

#ifdef __cplusplus
}
#endif

#endif
