/** @file
 * pt: the Vulkan devices, and the choice among them.
 *
 * pt_create_info.device is NULL for the best one (discrete, integrated, virtual, CPU, in that order). Otherwise it is
 * an index into pt_get_devices in decimal, "gpu" or "cpu", a UUID as 32 hexadecimal digits (dashes allowed), or a part
 * of a name, ignoring case. Several devices share the samples of a context, with the same bits if they are of one kind
 * and driver: "all" for all devices of the best kind, or indices or UUIDs separated by commas, each device once. UTF-8,
 * zero-terminated. */
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
    PT_DEVICE_DISCRETE_GPU = 2,   /**< has memory of its own */
    PT_DEVICE_VIRTUAL_GPU = 3,    /**< a virtual machine's */
    PT_DEVICE_CPU = 4             /**< a driver that runs kernels on the CPU */
};

/** A Vulkan device. */
typedef struct pt_device_info {
    uint32_t kind;         /**< PT_DEVICE_* */
    uint32_t suitable;     /**< 1: pt_create can use it; 0: reason says why not */
    uint64_t memory_bytes; /**< size of its largest memory heap that kernels can reach quickly */
    uint8_t uuid[16];      /**< tells two equal devices apart; stable over reboots */
    char name[256];        /**< UTF-8, zero-terminated, like the two below */
    char driver[256];      /**< driver name and version */
    char reason[256];      /**< empty if suitable */
} pt_device_info;

/** Lists the Vulkan devices.
 *
 * If devices is NULL, *count receives their number. Otherwise at most *count elements are written, and *count receives
 * how many were.
 *
 * Any thread. PT_ERROR_NO_DEVICE: Vulkan is not installed, or has no device. */
PT_API pt_result pt_get_devices(pt_device_info *devices, uint32_t *count);

/** Writes the device of this context, or the first of several. One thread at a time per context, also while samples
 * are under way (pt/async.h). */
PT_API pt_result pt_get_context_device(pt_context *context, pt_device_info *device);

#ifdef __cplusplus
}
#endif

#endif
