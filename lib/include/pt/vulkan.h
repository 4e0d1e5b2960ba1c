/** @file
 * pt: rendering on the caller's own Vulkan device.
 */
#ifndef PT_VULKAN_H
#define PT_VULKAN_H

#include <pt/pt.h>

#ifdef __cplusplus
extern "C" {
#endif

/** Called before or after every use of a queue, on the thread that called the library. */
typedef void (*pt_queue_fn)(void *user);

/** The caller's own Vulkan, for pt_create_info.vulkan. The context makes its objects on this device and submits its
 * work to this queue.
 *
 * - Needed: Instance and device come from the Vulkan loader that this library is linked to (libvulkan.so.1).
 *   VkApplicationInfo.apiVersion of the instance is 1.2 or higher, and the physical device supports Vulkan 1.2.
 *   VK_KHR_portability_subset is enabled if the device has it. The device was created from one physical device, not
 *   from a group. The queue's family has VK_QUEUE_COMPUTE_BIT.
 * - Lifetime: All handles must outlive the context, which destroys none of them. The context destroys its own objects
 *   in pt_destroy or earlier, without allocation callbacks.
 * - Threads: The context calls lock_queue and unlock_queue around every vkQueueSubmit, and not around waits or other
 *   callbacks. Without these functions no other thread may use the queue during a call on this context, not even by
 *   vkDeviceWaitIdle.
 * - Memory: The context uses only its own buffers and the caller's in pt_readback_to_buffer.
 * - Time: Earlier work in the queue must not wait for the calling thread. The time of a submission includes the wait
 *   for earlier work, so later submissions get smaller. If a submission has not ended after 10 seconds, the device
 *   counts as lost.
 * - Rounding: The caller must create the device while rounding to nearest, because a driver's threads inherit the mode.
 * - Loss: If submissions of this context have not ended at pt_destroy, their objects stay on the device until the
 *   process ends.
 *
 * The library checks only that the instance has the physical device. pt_create returns PT_ERROR_UNSUPPORTED if the
 * physical device is not suitable (pt_device_info.reason).
 */
struct pt_vulkan {
    uint32_t struct_size;     /**< sizeof(pt_vulkan) */
    uint32_t queue_family;    /**< index of the queue's family */
    void *instance;           /**< VkInstance; never NULL, like the next three */
    void *physical_device;    /**< VkPhysicalDevice */
    void *device;             /**< VkDevice */
    void *queue;              /**< VkQueue */
    pt_queue_fn lock_queue;   /**< returns when this thread may use the queue; NULL only if unlock_queue is NULL too */
    pt_queue_fn unlock_queue; /**< called by the thread that called lock_queue */
    void *queue_user;         /**< argument of both functions */
};

/** A buffer of the caller's device into which a kernel writes an image.
 *
 * - Memory: The buffer has VK_BUFFER_USAGE_STORAGE_BUFFER_BIT and memory of any type. The buffer belongs to pt_vulkan's
 *   queue family unless it is VK_SHARING_MODE_CONCURRENT.
 * - Before: The caller's earlier accesses to the memory must have ended, or wait_semaphore must be signalled after
 *   them. The signal operation must already be submitted. The kernel waits for the semaphore in
 *   VK_PIPELINE_STAGE_COMPUTE_SHADER_BIT.
 * - After: The writes are VK_ACCESS_SHADER_WRITE_BIT in VK_PIPELINE_STAGE_COMPUTE_SHADER_BIT. Without signal_semaphore
 *   the call returns when they are available, also to the host (VK_ACCESS_HOST_READ_BIT). The caller must invalidate
 *   mapped memory that is not coherent. Commands on the device see the writes after a barrier whose source is this
 *   access and stage. With signal_semaphore the call returns once the work is submitted. Commands that wait for the
 *   semaphore see the writes without a barrier, in the stages that wait.
 * - Lifetime: With signal_semaphore, the buffer and both semaphores must live until signal_semaphore has been signalled
 *   and waited for. Meanwhile the context may be used and destroyed; pt_set_render, pt_destroy and the next
 *   pt_readback_to_buffer wait for this call. */
typedef struct pt_buffer_image {
    uint32_t struct_size;      /**< sizeof(pt_buffer_image) */
    uint32_t quantity;         /**< PT_QUANTITY_RADIANCE, STANDARD_ERROR, SAMPLE_COUNT or COVERAGE */
    uint64_t buffer;           /**< VkBuffer, cast to uint64_t also where handles are pointers; never 0 */
    uint64_t offset_bytes;     /**< where the first pixel begins, a multiple of 4 */
    uint64_t size_bytes;       /**< the buffer's size; at least offset_bytes plus the minimum of pt_image.size_bytes */
    uint64_t row_bytes;        /**< distance between rows, a multiple of 4; default width * bytes of a pixel */
    uint32_t x;                /**< the rectangle, as in pt_image: all 0, or within the image */
    uint32_t y;                /**< see x */
    uint32_t width;            /**< see x */
    uint32_t height;           /**< see x */
    uint32_t format;           /**< PT_FORMAT_* */
    uint32_t reserved;         /**< 0 */
    uint64_t wait_semaphore;   /**< binary VkSemaphore to wait for, cast to uint64_t; 0: none */
    uint64_t signal_semaphore; /**< binary VkSemaphore to signal, cast to uint64_t; 0: the call waits */
} pt_buffer_image;

/** Writes the bits of pt_readback into a buffer of the device of pt_create_info.vulkan.
 *
 * If the driver has lost samples, a call without signal_semaphore fails with PT_ERROR_INTERNAL after it has written.
 * After a call with signal_semaphore, the next pt_readback_to_buffer fails instead and writes nothing. After other
 * failures, buffer and semaphores are unchanged unless the device was lost.
 *
 * One thread at a time. PT_ERROR_INVALID_STATE: the context was created without pt_create_info.vulkan, or there is no
 * sample. */
PT_API pt_result pt_readback_to_buffer(pt_context *context, const pt_buffer_image *image);

#ifdef __cplusplus
}
#endif

#endif
