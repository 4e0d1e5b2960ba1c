/** @file
 * pt: whether two images show the same light.
 *
 * The test looks at the difference of two images in the whole picture and in squares of 16, 32, 64, ... pixels. It
 * compares this difference with the differences of single pixels, whose errors are independent (shaders/README.md,
 * section 11). The test finds smaller changes if both images have the same seed. */
#ifndef PT_COMPARE_H
#define PT_COMPARE_H

#include <pt/pt.h>

#ifdef __cplusplus
extern "C" {
#endif

/** Values of pt_comparison.light. */
enum {
    PT_LIGHT_EQUAL_BITS = 1, /**< all numbers are equal */
    PT_LIGHT_SAME = 2,       /**< no difference beyond noise; a change of min_change would have been found */
    PT_LIGHT_DIFFERENT = 3,  /**< the light differs in some region */
    PT_LIGHT_UNDECIDED = 4   /**< no difference beyond noise, but a change of min_change may have been missed */
};

/** An image of pt_compare_info. */
typedef struct pt_compared_image {
    const float *radiance; /**< PT_QUANTITY_RADIANCE in PT_FORMAT_RGB32F, row by row without gaps; finite */
    uint32_t min_samples;  /**< fewest samples of a pixel; 0 if unknown */
    /** Most samples of a pixel. They must equal min_samples, because PT_SAMPLING_ADAPTIVE shifts means. */
    uint32_t max_samples;
    uint32_t sampler; /**< PT_SAMPLER_*, 0 if unknown; not PT_SAMPLER_HALTON, whose errors are not random */
    /** PT_ESTIMATOR_*, 0 if unknown. If only this image's estimator finds lamps by chance, the test ignores that it is
     * darker. */
    uint32_t estimator;
} pt_compared_image;

/** Input of pt_compare. */
typedef struct pt_compare_info {
    uint32_t struct_size; /**< sizeof(pt_compare_info) */
    uint32_t width;       /**< pixels of both images, >= 1 */
    uint32_t height;      /**< pixels, >= 1; width * height <= 2^32 - 1 */
    /** Number of this comparison, from 1, if images are compared repeatedly while samples are added. Comparison k has
     * the rate / (k (k + 1)), so all together have the rate. 0: the only comparison. */
    uint32_t look;
    pt_compared_image first;  /**< the image to be judged */
    pt_compared_image second; /**< the reference: changes are fractions of its light */
    double rate;              /**< probability of calling equal light different, in (0, 0.5]; default 10^-6 */
    double min_change;        /**< change of the light that must not be missed, a fraction >= 0; default 1 */
} pt_compare_info;

/** A part of the picture. Arrays are R, G, B. The struct is an element of arrays and gains no fields. */
typedef struct pt_compared_region {
    uint32_t x;           /**< first column */
    uint32_t y;           /**< first row */
    uint32_t width;       /**< pixels */
    uint32_t height;      /**< pixels */
    double light[3];      /**< mean of the second image */
    double difference[3]; /**< mean of the first image minus mean of the second image */
    double deviation[3];  /**< standard deviation of the difference */
    /** Upper bound of the probability that equal light differs as much in some region of this size. */
    double probability;
    /** Smallest change of the region's light, a fraction, that the test finds with 99% probability; INFINITY if it
     * finds none. */
    double smallest_change;
} pt_compared_region;

/** Output of pt_compare. */
typedef struct pt_comparison {
    uint32_t struct_size; /**< sizeof(pt_comparison) */
    uint32_t light;       /**< PT_LIGHT_* */
    double probability;   /**< upper bound of the probability that equal light differs as much */
    /** Smallest change of all light, a fraction, that the test finds with 99% probability; INFINITY if it finds
     * none. */
    double smallest_change;
    double smallest_tile_change; /**< median over tiles of 32 x 32 pixels of their smallest_change */
    double rate;                 /**< this look's rate; light differs where the probability is at most this */
    char summary[160];           /**< the result as a sentence; ASCII, zero-terminated */
} pt_comparison;

/** Compares the light of two images, and lists the compared regions.
 *
 * Regions are ordered by size: first the whole picture, last the tiles of 16 x 16 pixels, each size row by row. If
 * comparison and regions are NULL, *count receives the number of regions, and nothing is compared.
 *
 * Any thread. */
PT_API pt_result pt_compare(const pt_compare_info *info, pt_comparison *comparison, pt_compared_region *regions,
                            uint32_t *count);

#ifdef __cplusplus
}
#endif

#endif
