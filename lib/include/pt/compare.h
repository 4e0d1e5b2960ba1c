/** @file
 * pt: whether two images show the same light.
 *
 * The test looks at the difference of two images in the whole picture and in squares of 16, 32, 64, ... pixels, and
 * compares it with the differences of single pixels, whose errors are independent. shaders/README.md, section 11,
 * derives it. Images may share a seed: where their samples correspond, smaller changes are found. */
#ifndef PT_COMPARE_H
#define PT_COMPARE_H

#include <pt/pt.h>

#ifdef __cplusplus
extern "C" {
#endif

/** Values of pt_comparison.light. */
enum {
    PT_LIGHT_EQUAL_BITS = 1, /**< all numbers are equal */
    PT_LIGHT_SAME = 2,       /**< no difference beyond noise, and min_change would have been found */
    PT_LIGHT_DIFFERENT = 3,  /**< the light differs in some region */
    PT_LIGHT_UNDECIDED = 4   /**< no difference beyond noise, but a change of min_change may have been missed */
};

/** An image of pt_compare_info. */
typedef struct pt_compared_image {
    const float *radiance; /**< PT_QUANTITY_RADIANCE in PT_FORMAT_RGB32F, row by row without gaps; finite */
    uint32_t min_samples;  /**< fewest samples of a pixel; 0 if unknown */
    uint32_t max_samples;  /**< most samples of a pixel; must be min_samples, since PT_SAMPLING_ADAPTIVE shifts means */
    uint32_t sampler;      /**< PT_SAMPLER_*, 0 if unknown; not PT_SAMPLER_HALTON, whose errors are not random */
    /** not 0: lamps are found by chance and may not have been met (PT_UNCERTAIN_UNMET). If the other image's are not, a
     * lack of light in this one says nothing */
    uint32_t may_miss_light;
} pt_compared_image;

/** Input of pt_compare. */
typedef struct pt_compare_info {
    uint32_t struct_size; /**< sizeof(pt_compare_info) */
    uint32_t width;       /**< pixels of both images, >= 1 */
    uint32_t height;      /**< pixels, >= 1; width * height <= 2^32 - 1 */
    uint32_t look; /**< number, from 1, of this look at growing images: look k has the rate / (k (k + 1)), so that
                    * all looks together have the rate. 0: the only look */
    pt_compared_image first;  /**< the image to be judged */
    pt_compared_image second; /**< the reference: changes are shares of its light */
    double rate;              /**< probability of calling equal light different; in (0, 0.5], 0 for 10^-6 */
    double min_change;        /**< change of the light that must not be missed, as a share; >= 0, 0 for 1 */
} pt_compare_info;

/** A part of the picture. Arrays are R, G, B. It is an element of arrays, and so frozen. */
typedef struct pt_compared_region {
    uint32_t x;             /**< first column */
    uint32_t y;             /**< first row */
    uint32_t width;         /**< pixels */
    uint32_t height;        /**< pixels */
    double light[3];        /**< mean of the second image */
    double difference[3];   /**< mean of the first image minus that */
    double deviation[3];    /**< standard deviation of the difference */
    double probability;     /**< at most, that equal light shows such a difference in any region of this size */
    double smallest_change; /**< smallest change of the region's light that would be found with 99%, as a share;
                             * INFINITY if none would */
} pt_compared_region;

/** Output of pt_compare. */
typedef struct pt_comparison {
    uint32_t struct_size;   /**< sizeof(pt_comparison); must be set by the caller */
    uint32_t light;         /**< PT_LIGHT_* */
    double probability;     /**< at most, that equal light shows such differences */
    double smallest_change; /**< smallest change of all light that would be found with 99%, as a share; INFINITY if none
                             * would */
    double smallest_tile_change; /**< the same of a tile of 32 x 32 pixels alone: the median over these tiles */
    char summary[160];           /**< all that as a sentence: ASCII, ends with a zero */
} pt_comparison;

/** Compares the light of two images.
 *
 * comparison->struct_size must be set; no more bytes than that are written. *count is the number of elements of
 * regions, and receives how many were written. If regions is NULL, *count receives how many there are. Regions are
 * ordered by size: the whole picture first, tiles of 16 x 16 pixels last, each size row by row.
 *
 * Any thread; pt_last_error(NULL) has the message of a failure. PT_ERROR_INVALID_ARGUMENT: a rule is broken. */
PT_API pt_result pt_compare(const pt_compare_info *info, pt_comparison *comparison, pt_compared_region *regions,
                            uint32_t *count);

#ifdef __cplusplus
}
#endif

#endif
