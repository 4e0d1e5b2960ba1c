/** @file
 * pt: whether two images show the same light.
 *
 * The test sums the difference of two images over the whole picture and over squares of 16, 32, 64, ... pixels. The
 * differences of single pixels, whose errors are independent, show how large such a sum is by chance
 * (shaders/README.md, section 11). The test finds smaller changes if both images have the same seed. */
#ifndef PT_COMPARE_H
#define PT_COMPARE_H

#include <pt/pt.h>

#ifdef __cplusplus
extern "C" {
#endif

/** Values of pt_comparison.light. */
enum {
    PT_LIGHT_EQUAL_BITS = 1, /**< all numbers are equal */
    PT_LIGHT_SAME = 2,       /**< no difference beyond noise; the test would have found a change of min_change */
    PT_LIGHT_DIFFERENT = 3,  /**< the light differs in some region */
    PT_LIGHT_UNDECIDED = 4   /**< no difference beyond noise, but the test may have missed a change of min_change */
};

/** An image of pt_compare_info. */
typedef struct pt_compared_image {
    const float *radiance; /**< PT_QUANTITY_RADIANCE in PT_FORMAT_RGB32F, row by row without gaps; finite */
    uint32_t min_samples;  /**< fewest samples of a pixel; 0 if unknown */
    /** Most samples of a pixel. Must equal min_samples, because numbers of samples that depend on the light
     * (PT_SAMPLING_ADAPTIVE) shift the mean. */
    uint32_t max_samples;
    uint32_t sampler; /**< PT_SAMPLER_*, 0 if unknown; not PT_SAMPLER_HALTON, whose errors are not random */
    /** PT_ESTIMATOR_*, 0 if unknown. If it finds lamps by chance (uniform, cosine, bsdf) and the other image's
     * estimator does not, a darker image is not evidence of different light. */
    uint32_t estimator;
} pt_compared_image;

/** Input of pt_compare. */
typedef struct pt_compare_info {
    uint32_t struct_size; /**< sizeof(pt_compare_info) */
    uint32_t width;       /**< pixels of both images, >= 1 */
    uint32_t height;      /**< pixels, >= 1; width * height <= 2^32 - 1 */
    /** 0 for a single comparison. Comparisons repeated while samples are added have the numbers k = 1, 2, ....
     * Comparison k uses rate / (k (k + 1)), and these sum to rate. */
    uint32_t look;
    pt_compared_image first;  /**< the image to be judged */
    pt_compared_image second; /**< the reference; changes are fractions of its light */
    double rate;              /**< probability of calling equal light different, in (0, 0.5]; default 10^-6 */
    double min_change;        /**< change of light that must not be missed, a fraction >= 0; default 1 */
} pt_compare_info;

/** A region of the picture. Arrays are R, G, B. */
typedef struct pt_compared_region {
    uint32_t x;           /**< first column */
    uint32_t y;           /**< first row */
    uint32_t width;       /**< pixels */
    uint32_t height;      /**< pixels */
    double light[3];      /**< mean of the second image */
    double difference[3]; /**< mean of the first image minus mean of the second image */
    double deviation[3];  /**< standard deviation of the difference */
    /** Upper bound of the probability that equal light gives a difference this large in some region of this size. */
    double probability;
    /** Smallest change of the region's light, a fraction, that the test finds with 99% probability; INFINITY: it finds
     * no change. */
    double smallest_change;
} pt_compared_region;

/** Output of pt_compare. */
typedef struct pt_comparison {
    uint32_t struct_size; /**< sizeof(pt_comparison) */
    uint32_t light;       /**< PT_LIGHT_* */
    double probability;   /**< upper bound of the probability that equal light differs as much */
    /** Smallest change of all light, like pt_compared_region.smallest_change. */
    double smallest_change;
    double smallest_tile_change; /**< median over tiles of 32 x 32 pixels of their smallest_change */
    double rate;       /**< rate of this comparison; a region differs if its probability is at most this rate */
    char summary[160]; /**< the result as a sentence; ASCII, zero-terminated */
} pt_comparison;

/** Compares the light of two images, and lists the compared regions.
 *
 * The first region is the whole picture. Squares follow, the largest first and each size row by row. If comparison and
 * regions are NULL, nothing is compared.
 *
 * Any thread. */
PT_API pt_result pt_compare(const pt_compare_info *info, pt_comparison *comparison, pt_compared_region *regions,
                            uint32_t *count);

#ifdef __cplusplus
}
#endif

#endif
