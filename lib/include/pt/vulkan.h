/** @file
 * pt: rendering on a device of the caller's own, for programs that use Vulkan themselves.
 */
#ifndef PT_VULKAN_H
#define PT_VULKAN_H

#include <pt/pt.h>

#ifdef __cplusplus
extern "C" {
#endif

/** Called around every use of a queue, on the thread that called the library; user is pt_vulkan.queue_user. */
typedef void (*pt_queue_fn)(void *user);

/** The caller's own Vulkan, for pt_create_info.vulkan: the context makes its objects on this device and submits its
 * work to this queue, with the same bits as on a device of its own.
 *
 * Needed     instance and device come from the Vulkan loader that this library is linked to (libvulkan.so.1). The
 *            instance was created with VkApplicationInfo.apiVersion 1.2 or higher, and the physical device supports
 *            Vulkan 1.2: the kernels are SPIR-V 1.5. No feature and no extension is needed, but
 *            VK_KHR_portability_subset where the device has it, as Vulkan demands. The device was made of one physical
 *            device, not of a group. The queue's family has VK_QUEUE_COMPUTE_BIT.
 * Lifetime   all handles must outlive the context, which destroys none of them. It destroys what it has made, without
 *            allocation callbacks, at the latest in pt_destroy, and waits for its own submissions only, by fences.
 * Threads    Vulkan wants a queue used by one thread at a time. The context calls lock_queue and unlock_queue around
 *            every vkQueueSubmit, and does not hold the queue while it waits or calls back; they may be a mutex that
 *            all users of the queue lock, other contexts included. Without them nobody else may use the queue during a
 *            call on this context, vkDeviceWaitIdle included. All else that the context does needs no lock: Vulkan lets
 *            threads share a device.
 * Order      the context uses its own buffers alone. Its pipeline barriers are for compute and transfers, and may delay
 *            commands of others in the queue, never change them.
 * Time       work of others that is before the context's in the queue must not wait for the calling thread. It counts
 *            as time of the context's submissions: it makes them smaller, and on a GPU a submission that has not ended
 *            after 10 seconds means that the device is lost.
 * Rounding   a driver's threads that compute inherit the floating-point mode of who starts them, so the caller has to
 *            make the device with rounding to nearest.
 * Loss       PT_ERROR_DEVICE_LOST from then on, whoever lost the device. If it hangs, so that submissions of this
 *            context have not ended by pt_destroy, what they use stays behind on the device until the process ends.
 *
 * Errors of pt_create: PT_ERROR_INVALID_ARGUMENT for a field that breaks a rule given here, as far as that can be seen.
 * It cannot be seen whether the handles are alive and belong together (but the physical device, which is looked for in
 * the instance), nor that an instance is older than 1.2 where the driver offers newer functions regardless.
 * PT_ERROR_UNSUPPORTED if the physical device does not fit (pt_device_info.reason). Others as without pt_vulkan.
 */
struct pt_vulkan {
    uint32_t struct_size;     /**< sizeof(pt_vulkan) */
    uint32_t queue_family;    /**< index of the queue's family */
    void *instance;           /**< VkInstance, like the next three never NULL */
    void *physical_device;    /**< VkPhysicalDevice, one of the instance's */
    void *device;             /**< VkDevice, made of the physical device */
    void *queue;              /**< VkQueue of the device and of the family */
    pt_queue_fn lock_queue;   /**< returns when this thread may use the queue; NULL together with unlock_queue */
    pt_queue_fn unlock_queue; /**< called by the thread that called lock_queue */
    void *queue_user;         /**< handed to both */
};

#ifdef __cplusplus
}
#endif

#endif
