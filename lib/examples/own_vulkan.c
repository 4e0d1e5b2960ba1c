/* Rendering on the program's own Vulkan device. The program makes instance, device and queue, passes them to a context,
 * and uses them itself afterwards. A mutex guards the queue, as if several threads used it.
 *
 * Exit status 0 if the context rendered and the device then ran the program's own work.
 */
#include <pt/pt.h>
#include <pt/vulkan.h>
#include <vulkan/vulkan.h>

#include <pthread.h>
#include <stdio.h>
#include <stdlib.h>

enum { WIDTH = 64, HEIGHT = 48, MAX_DEVICES = 16, MAX_FAMILIES = 16 };

typedef struct own_vulkan {
    VkInstance instance;
    VkPhysicalDevice physical_device;
    VkDevice device;
    uint32_t queue_family;
    VkQueue queue;
    pthread_mutex_t queue_mutex;
} own_vulkan;

/* pt needs an instance of Vulkan 1.2. */
static VkResult make_instance(own_vulkan *own) {
    const VkApplicationInfo application = {.sType = VK_STRUCTURE_TYPE_APPLICATION_INFO,
                                           .apiVersion = VK_API_VERSION_1_2};
    const VkInstanceCreateInfo info = {.sType = VK_STRUCTURE_TYPE_INSTANCE_CREATE_INFO,
                                       .pApplicationInfo = &application};
    return vkCreateInstance(&info, NULL, &own->instance);
}

static int has_compute(VkPhysicalDevice device, uint32_t *family) {
    VkQueueFamilyProperties families[MAX_FAMILIES];
    uint32_t count = MAX_FAMILIES;

    vkGetPhysicalDeviceQueueFamilyProperties(device, &count, families);
    for (*family = 0; *family < count; ++*family)
        if (families[*family].queueFlags & VK_QUEUE_COMPUTE_BIT)
            return 1;
    return 0;
}

static VkResult choose_device(own_vulkan *own) {
    VkPhysicalDevice devices[MAX_DEVICES];
    uint32_t count = MAX_DEVICES;
    const VkResult result = vkEnumeratePhysicalDevices(own->instance, &count, devices);

    if (result < 0)
        return result;
    for (uint32_t i = 0; i < count; ++i) {
        VkPhysicalDeviceProperties properties;
        vkGetPhysicalDeviceProperties(devices[i], &properties);
        if (properties.apiVersion >= VK_API_VERSION_1_2 && has_compute(devices[i], &own->queue_family)) {
            own->physical_device = devices[i];
            printf("on %s\n", properties.deviceName);
            return VK_SUCCESS;
        }
    }
    return VK_ERROR_INCOMPATIBLE_DRIVER;
}

/* pt needs no features. It needs no extensions either, because devices with VK_KHR_portability_subset are listed only
 * if the instance requests them. */
static VkResult make_device(own_vulkan *own) {
    const float priority = 1.0f;
    const VkDeviceQueueCreateInfo queue = {.sType = VK_STRUCTURE_TYPE_DEVICE_QUEUE_CREATE_INFO,
                                           .queueFamilyIndex = own->queue_family,
                                           .queueCount = 1,
                                           .pQueuePriorities = &priority};
    const VkDeviceCreateInfo info = {
        .sType = VK_STRUCTURE_TYPE_DEVICE_CREATE_INFO, .queueCreateInfoCount = 1, .pQueueCreateInfos = &queue};
    const VkResult result = vkCreateDevice(own->physical_device, &info, NULL, &own->device);

    if (result == VK_SUCCESS)
        vkGetDeviceQueue(own->device, own->queue_family, 0, &own->queue);
    return result;
}

/* After a failure, unmake() destroys the objects made so far. */
static VkResult make(own_vulkan *own) {
    VkResult result = make_instance(own);

    if (result == VK_SUCCESS)
        result = choose_device(own);
    if (result == VK_SUCCESS)
        result = make_device(own);
    return result;
}

static void unmake(own_vulkan *own) {
    if (own->device)
        vkDestroyDevice(own->device, NULL);
    if (own->instance)
        vkDestroyInstance(own->instance, NULL);
}

static void lock_queue(void *user) {
    pthread_mutex_lock(user);
}

static void unlock_queue(void *user) {
    pthread_mutex_unlock(user);
}

static pt_result render_on(pt_context *context, float *pixels, uint64_t size_bytes) {
    /* The sphere around the camera emits red 1, green 2 and blue 4, so every pixel has these values. */
    static const pt_material material = {{0.0f, 0.0f, 0.0f}, {0.0f, 0.0f, 0.0f}, {1.0f, 2.0f, 4.0f}, 0.0f, 0};
    static const pt_sphere sphere = {{0.0, 0.0, 0.0}, 5.0, {0.0, 0.0, 0.0}, 0, 0};
    const pt_scene scene = {
        .struct_size = sizeof scene,
        .material_count = 1,
        .sphere_count = 1,
        .materials = &material,
        .spheres = &sphere,
    };
    const pt_camera camera = {.struct_size = sizeof camera, .target = {0.0, 0.0, -1.0}};
    const pt_render render = {.struct_size = sizeof render, .width = WIDTH, .height = HEIGHT};
    const pt_accumulate_info samples = {.struct_size = sizeof samples, .sample_count = 16};
    const pt_image image = {.struct_size = sizeof image, .data = pixels, .size_bytes = size_bytes};
    pt_result result = pt_set_scene(context, &scene);

    if (result >= 0)
        result = pt_set_camera(context, &camera);
    if (result >= 0)
        result = pt_set_render(context, &render);
    if (result >= 0)
        result = pt_accumulate(context, &samples);
    if (result >= 0)
        result = pt_readback(context, &image);
    return result;
}

/* The context must be destroyed before the Vulkan objects that it uses. */
static pt_result render(own_vulkan *own, float *pixels, uint64_t size_bytes) {
    const pt_vulkan vulkan = {.struct_size = sizeof vulkan,
                              .queue_family = own->queue_family,
                              .instance = own->instance,
                              .physical_device = own->physical_device,
                              .device = own->device,
                              .queue = own->queue,
                              .lock_queue = lock_queue,
                              .unlock_queue = unlock_queue,
                              .queue_user = &own->queue_mutex};
    const pt_create_info info = {.struct_size = sizeof info, .vulkan = &vulkan};
    pt_context *context;
    pt_result result = pt_create(&info, &context);

    if (result >= 0)
        result = render_on(context, pixels, size_bytes);
    if (result < 0)
        fprintf(stderr, "%s: %s\n", pt_result_name(result), pt_last_error(context));
    pt_destroy(context);
    return result;
}

/* Checks that the device still works for this program: the queue signals a fence. */
static VkResult use_queue(own_vulkan *own) {
    const uint64_t nanoseconds = 5000000000u;
    const VkFenceCreateInfo info = {.sType = VK_STRUCTURE_TYPE_FENCE_CREATE_INFO};
    VkFence fence;
    VkResult result = vkCreateFence(own->device, &info, NULL, &fence);

    if (result != VK_SUCCESS)
        return result;
    pthread_mutex_lock(&own->queue_mutex);
    result = vkQueueSubmit(own->queue, 0, NULL, fence);
    pthread_mutex_unlock(&own->queue_mutex);
    if (result == VK_SUCCESS)
        result = vkWaitForFences(own->device, 1, &fence, VK_TRUE, nanoseconds);
    vkDestroyFence(own->device, fence, NULL);
    return result;
}

int main(void) {
    static float pixels[WIDTH * HEIGHT * 3];
    own_vulkan own = {.queue_mutex = PTHREAD_MUTEX_INITIALIZER};
    VkResult made = make(&own);
    int status = EXIT_FAILURE;

    if (made == VK_SUCCESS && render(&own, pixels, sizeof pixels) >= 0) {
        printf("a pixel is (%g, %g, %g)\n", (double)pixels[0], (double)pixels[1], (double)pixels[2]);
        made = use_queue(&own);
        if (made == VK_SUCCESS && pixels[0] == 1.0f && pixels[1] == 2.0f && pixels[2] == 4.0f)
            status = EXIT_SUCCESS;
    }
    if (made != VK_SUCCESS)
        fprintf(stderr, "Vulkan: error %d\n", made);
    unmake(&own);
    return status;
}
