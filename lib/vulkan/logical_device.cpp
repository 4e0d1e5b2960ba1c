// Creation of devices, and the use of queues; see logical_device.h.
#include "lib/vulkan/logical_device.h"

#include "lib/vulkan/result.h"

#include <cstring>
#include <mutex>
#include <new>
#include <utility>
#include <vector>

namespace pt::vulkan {

namespace {

// A queue family for compute, preferably one without graphics: that is meant for background work.
std::uint32_t compute_family(const vk::raii::PhysicalDevice &device) {
    const std::vector<vk::QueueFamilyProperties> families = device.getQueueFamilyProperties();
    std::uint32_t best = 0;
    for (std::uint32_t i = 0; i < families.size(); ++i) {
        const bool computes = static_cast<bool>(families[i].queueFlags & vk::QueueFlagBits::eCompute);
        const bool draws = static_cast<bool>(families[i].queueFlags & vk::QueueFlagBits::eGraphics);
        if (computes && (!draws || !(families[best].queueFlags & vk::QueueFlagBits::eCompute)))
            best = i;
    }
    return best;
}

vk::raii::Device create_device(const vk::raii::PhysicalDevice &physical_device, std::uint32_t family) {
    // The specification demands that this extension be enabled if it exists. What such devices may lack, of images,
    // events and drawing, nothing here uses.
    constexpr const char *portability_subset = "VK_KHR_portability_subset";
    std::vector<const char *> extensions;
    for (const vk::ExtensionProperties &extension : physical_device.enumerateDeviceExtensionProperties())
        if (std::strcmp(extension.extensionName, portability_subset) == 0)
            extensions.push_back(portability_subset);
    const float priority = 1.0F;
    const vk::DeviceQueueCreateInfo queue{.queueFamilyIndex = family, .queueCount = 1, .pQueuePriorities = &priority};
    const auto &functions = *physical_device.getDispatcher();
    const vk::Device device = (*physical_device)
                                  .createDevice({.queueCreateInfoCount = 1,
                                                 .pQueueCreateInfos = &queue,
                                                 .enabledExtensionCount = static_cast<std::uint32_t>(extensions.size()),
                                                 .ppEnabledExtensionNames = extensions.data()},
                                                nullptr, functions);
    try {
        return {physical_device, device};
    } catch (const std::bad_alloc &) { // no memory for the table of its functions
        const PFN_vkVoidFunction destroy = functions.vkGetDeviceProcAddr(device, "vkDestroyDevice");
        reinterpret_cast<PFN_vkDestroyDevice>(destroy)(device, nullptr);
        throw;
    }
}

} // namespace

LogicalDevice::LogicalDevice(vk::raii::Device device, vk::Queue queue, std::uint32_t queue_family,
                             const QueueLock &lock, bool owned) :
    device_(std::move(device)),
    is_owned_(owned),
    queue_(device_, queue),
    queue_family_(queue_family),
    queue_lock_(lock) {}

LogicalDevice LogicalDevice::create(const vk::raii::PhysicalDevice &physical_device) {
    const std::uint32_t family = compute_family(physical_device);
    return translated("creating the device", [&] {
        vk::raii::Device device = create_device(physical_device, family);
        const vk::Queue queue = *device.getQueue(family, 0);
        return LogicalDevice(std::move(device), queue, family, {}, true);
    });
}

LogicalDevice LogicalDevice::borrow(const vk::raii::PhysicalDevice &physical_device, const CallerVulkan &caller) {
    return {{physical_device, caller.device}, caller.queue, caller.queue_family, caller.queue_lock, false};
}

std::chrono::steady_clock::time_point LogicalDevice::submit(const vk::SubmitInfo &work, vk::Fence fence) const {
    const std::lock_guard held(queue_lock_);
    const auto start = std::chrono::steady_clock::now();
    queue_.submit(work, fence);
    return start;
}

} // namespace pt::vulkan
