#include "lib/vulkan/logical_device.h"

#include <cstring>
#include <new>
#include <vector>

namespace pt::vulkan {

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

vk::raii::Device create_device(const vk::raii::PhysicalDevice &physical_device, std::uint32_t queue_family) {
    // If a device has this extension, Vulkan requires that it is enabled.
    constexpr const char *portability_subset = "VK_KHR_portability_subset";
    std::vector<const char *> extensions;
    for (const vk::ExtensionProperties &extension : physical_device.enumerateDeviceExtensionProperties())
        if (std::strcmp(extension.extensionName, portability_subset) == 0)
            extensions.push_back(portability_subset);
    const float priority = 1.0F;
    const vk::DeviceQueueCreateInfo queue{
        .queueFamilyIndex = queue_family, .queueCount = 1, .pQueuePriorities = &priority};
    const auto &functions = *physical_device.getDispatcher();
    const vk::Device device = (*physical_device)
                                  .createDevice({.queueCreateInfoCount = 1,
                                                 .pQueueCreateInfos = &queue,
                                                 .enabledExtensionCount = static_cast<std::uint32_t>(extensions.size()),
                                                 .ppEnabledExtensionNames = extensions.data()},
                                                nullptr, functions);
    try {
        return {physical_device, device};
    } catch (const std::bad_alloc &) {
        const PFN_vkVoidFunction destroy = functions.vkGetDeviceProcAddr(device, "vkDestroyDevice");
        reinterpret_cast<PFN_vkDestroyDevice>(destroy)(device, nullptr);
        throw;
    }
}

} // namespace pt::vulkan
