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
 *            Vulkan 1.2: the kernels are SPIR-V 1.5. No feature or extension is needed, except
 *            VK_KHR_portability_subset if the device has it. The device was created from one physical device, not from
 *            a group. The queue's family has VK_QUEUE_COMPUTE_BIT.
 * Lifetime   all handles must outlive the context, which destroys none of them. Its own objects are destroyed at the
 *            latest in pt_destroy, without allocation callbacks. It waits only for its own submissions, by fences.
 * Threads    Vulkan allows a queue one thread at a time. The context calls lock_queue and unlock_queue around every
 *            vkQueueSubmit, and holds no lock while it waits or calls back. They may lock a mutex that all users of the
 *            queue share. Without them nobody else may use the queue during a call on this context, not even by
 *            vkDeviceWaitIdle. All other use of the device needs no lock.
 * Order      the context uses only its own buffers and those that pt_readback_to_buffer names. Its pipeline barriers
 *            for compute and transfers may delay other commands in the queue, but never change their results.
 * Time       other work ahead in the queue must not wait for the calling thread. Time spent behind that work counts as
 *            the submission's own: later ones get smaller, and after 10 seconds without an end the GPU counts as lost.
 * Rounding   drivers' threads inherit the floating-point mode of the thread that starts them, so the caller must create
 *            the device while rounding to nearest.
 * Loss       calls fail with PT_ERROR_DEVICE_LOST. If submissions of this context hang at pt_destroy, their objects are
 *            left on the device until the process ends.
 *
 * Errors of pt_create: PT_ERROR_INVALID_ARGUMENT for a field that breaks a rule. The library cannot see whether handles
 * are alive and belong together (except that it looks for the physical device in the instance), nor that an instance is
 * older than 1.2 if the driver offers newer functions all the same. PT_ERROR_UNSUPPORTED if the physical device is not
 * suitable (pt_device_info.reason). Other errors are as without pt_vulkan.
 */
struct pt_vulkan {
    uint32_t struct_size;     /**< sizeof(pt_vulkan) */
    uint32_t queue_family;    /**< index of the queue's family */
    void *instance;           /**< VkInstance, like the next three never NULL */
    void *physical_device;    /**< VkPhysicalDevice, one of the instance's */
    void *device;             /**< VkDevice, created from the physical device */
    void *queue;              /**< VkQueue of the device and of the family */
    pt_queue_fn lock_queue;   /**< returns when this thread may use the queue; NULL together with unlock_queue */
    pt_queue_fn unlock_queue; /**< called by the thread that called lock_queue */
    void *queue_user;         /**< handed to both */
};

/** A buffer of the lent device into which a kernel writes an image, or a rectangle of it, without passing through the
 * host.
 *
 * Memory     the buffer has VK_BUFFER_USAGE_STORAGE_BUFFER_BIT and memory of any type, and belongs to pt_vulkan's queue
 *            family unless it is VK_SHARING_MODE_CONCURRENT. Nothing is written between the rows, or before or after
 *            the image. vkCmdCopyBufferToImage copies it into a VkImage.
 * Before     the caller's earlier accesses to the memory must have ended, as a fence shows, or wait_semaphore is
 *            signalled after them: the kernel's writes wait for it in VK_PIPELINE_STAGE_COMPUTE_SHADER_BIT. Its signal
 *            operation must have been submitted already. (Mesa's lavapipe makes the call wait.)
 * After      the writes are VK_ACCESS_SHADER_WRITE_BIT in VK_PIPELINE_STAGE_COMPUTE_SHADER_BIT. Without
 *            signal_semaphore the call returns when they have ended and are available, also to the host
 *            (VK_ACCESS_HOST_READ_BIT): mapped memory that is not coherent is to be invalidated, and commands on the
 *            device see them after a barrier with that source. With signal_semaphore the call returns once the work is
 *            submitted, and commands that wait for the semaphore see them without a barrier, in the stages that wait.
 * Lifetime   with signal_semaphore, the buffer and both semaphores must live until it has been signalled and waited
 *            for. The context may be used and destroyed meanwhile: the queue orders later changes of its memory behind
 *            this call, and pt_set_render, pt_destroy and the next pt_readback_to_buffer wait for it. */
typedef struct pt_buffer_image {
    uint32_t struct_size;      /**< sizeof(pt_buffer_image) */
    uint32_t quantity;         /**< PT_QUANTITY_RADIANCE, STANDARD_ERROR or SAMPLE_COUNT: see pt_readback */
    uint64_t buffer;           /**< VkBuffer, cast to uint64_t also where handles are pointers; never 0 */
    uint64_t offset_bytes;     /**< where the first pixel begins, a multiple of 4 */
    uint64_t size_bytes;       /**< the buffer's size; at least offset_bytes and, as in pt_image, what the rows take */
    uint64_t row_bytes;        /**< distance between rows, a multiple of 4; default width * bytes of a pixel */
    uint32_t x;                /**< the rectangle, as in pt_image: all 0, or within the image */
    uint32_t y;                /**< see x */
    uint32_t width;            /**< see x */
    uint32_t height;           /**< see x */
    uint32_t format;           /**< PT_FORMAT_* */
    uint32_t reserved;         /**< 0 */
    uint64_t wait_semaphore;   /**< binary VkSemaphore to wait for, cast, or 0: none */
    uint64_t signal_semaphore; /**< binary VkSemaphore to signal, cast, or 0: the call waits for the device */
} pt_buffer_image;

/** Does a pt_readback, with the same bits, into a buffer of the device that pt_create_info.vulkan lent.
 *
 * If the driver has lost samples, a call without signal_semaphore fails with PT_ERROR_INTERNAL after it has written;
 * after a call with one, the next pt_readback_to_buffer fails and writes nothing. Other failures leave buffer and
 * semaphores alone, unless the device was lost.
 *
 * One thread at a time per context. PT_ERROR_INVALID_STATE: the context has a device of its own, or there is no sample.
 * PT_ERROR_INVALID_ARGUMENT: the image breaks a rule. PT_ERROR_SHADER, PT_ERROR_OUT_OF_DEVICE_MEMORY,
 * PT_ERROR_DEVICE_LOST: the driver said so. */
PT_API pt_result pt_readback_to_buffer(pt_context *context, const pt_buffer_image *image);

#ifdef __cplusplus
}
#endif

#endif
