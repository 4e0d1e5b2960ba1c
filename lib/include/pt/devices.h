/** @file
 * pt: the Vulkan devices, and the choice among them.
 *
 * pt_create_info.device chooses a device, or several that share the samples. It is UTF-8, zero-terminated.
 * - NULL: the best device, in the order discrete, integrated, virtual, CPU
 * - a decimal index into pt_get_devices, or a UUID of 32 hexadecimal digits, with dashes or without
 * - "gpu" or "cpu"
 * - a part of a name, ignoring case
 * - "all": all devices of the best kind
 * - indices or UUIDs separated by commas, each device once
 *
 * Several devices of one model and driver give the same bits as one of them.
 *
 * llvmpipe, which runs on CPUs, reads the width of its vectors from the environment when the process makes its first
 * instance. A program that renders on llvmpipe can be started with the variables that `pt devices --vector-width tree`
 * prints, or set them before its threads. The width does not change the bits. */
#ifndef PT_DEVICES_H
#define PT_DEVICES_H

#include <pt/pt.h>

#ifdef __cplusplus
extern "C" {
#endif

/** Values of pt_device_info.kind. */
enum {
    PT_DEVICE_OTHER = 0,          /**< none of the others */
    PT_DEVICE_INTEGRATED_GPU = 1, /**< shares the memory of the machine */
    PT_DEVICE_DISCRETE_GPU = 2,   /**< has its own memory */
    PT_DEVICE_VIRTUAL_GPU = 3,    /**< the GPU of a virtual machine */
    PT_DEVICE_CPU = 4             /**< a driver that runs on the CPU */
};

/** A Vulkan device. */
typedef struct pt_device_info {
    uint32_t kind;         /**< PT_DEVICE_* */
    uint32_t suitable;     /**< 1: pt_create can use it; 0: reason says why not */
    uint64_t memory_bytes; /**< size of the largest memory heap that kernels can reach quickly */
    uint8_t uuid[16];      /**< differs between equal devices; stable over reboots */
    char name[256];        /**< UTF-8, zero-terminated, like driver and reason */
    char driver[256];      /**< driver name and version */
    char reason[256];      /**< empty if suitable */
} pt_device_info;

/** Lists the Vulkan devices. Any thread. PT_ERROR_NO_DEVICE: Vulkan is not installed, or has no device. */
PT_API pt_result pt_get_devices(pt_device_info *devices, uint32_t *count);

/** Writes the first device of this context. One thread at a time, also while samples are being taken (pt/async.h). */
PT_API pt_result pt_get_context_device(pt_context *context, pt_device_info *device);

#ifdef __cplusplus
}
#endif

#endif
