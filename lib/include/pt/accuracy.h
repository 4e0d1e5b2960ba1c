/** @file
 * pt: accuracy of the kernel's elementary functions, for self-tests of devices and drivers. */
#ifndef PT_ACCURACY_H
#define PT_ACCURACY_H

#include <pt/pt.h>

#ifdef __cplusplus
extern "C" {
#endif

/** A device's accuracy in one elementary function. Errors are in ulp: 2^(e - 23) for exact values y with 2^e <= |y| <
 * 2^(e + 1). */
typedef struct pt_function_accuracy {
    char name[40];      /**< UTF-8, zero-terminated */
    double worst_error; /**< >= 0; INFINITY if the device returned NaN, infinity or nothing */
    double bound;       /**< largest error that Vulkan allows */
    double worst_input; /**< argument of worst_error */
} pt_function_accuracy;

/** Compares the kernel's elementary functions on this context's device with double precision, for fixed inputs.
 *
 * Lists an element per function; if rows is NULL, no function is evaluated. Needs no scene. One thread at a time. */
PT_API pt_result pt_get_accuracy(pt_context *context, pt_function_accuracy *rows, uint32_t *count);

#ifdef __cplusplus
}
#endif

#endif
