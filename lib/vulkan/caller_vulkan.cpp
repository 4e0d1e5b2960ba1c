#include "lib/vulkan/caller_vulkan.h"

#include "lib/base/error.h"
#include "lib/base/rules.h"
#include "lib/vulkan/device_choice.h"
#include "lib/vulkan/result.h"

#include <algorithm>
#include <array>
#include <cstdio>
#include <string>
#include <vector>

namespace pt::vulkan {

namespace {

std::string pointer_text(const void *pointer) {
    std::array<char, 32> text{};
    std::snprintf(text.data(), text.size(), "%p", pointer);
    return text.data();
}

// An instance cannot report its version, but only devices of Vulkan 1.2 should have this function.
bool offers_version_1_2(const vk::raii::Instance &instance, VkDevice device) {
    return instance.getDispatcher()->vkGetDeviceProcAddr(device, "vkGetSemaphoreCounterValue") != nullptr;
}

} // namespace

CallerVulkan validated_vulkan(const pt_vulkan &vulkan) {
    Violations violations;
    const Subject subject(violations, "vulkan");
    const auto require = [&](bool holds, const char *field, const char *rule) {
        if (!holds)
            subject.refuse(field, "NULL", rule);
    };
    constexpr const char *not_null = "must not be NULL";
    require(vulkan.instance, "instance", not_null);
    require(vulkan.physical_device, "physical_device", not_null);
    require(vulkan.device, "device", not_null);
    require(vulkan.queue, "queue", not_null);
    require(vulkan.lock_queue || !vulkan.unlock_queue, "lock_queue", "must not be NULL with unlock_queue");
    require(vulkan.unlock_queue || !vulkan.lock_queue, "unlock_queue", "must not be NULL with lock_queue");
    violations.throw_if_any(PT_ERROR_INVALID_ARGUMENT);
    return {.instance = static_cast<VkInstance>(vulkan.instance),
            .physical_device = static_cast<VkPhysicalDevice>(vulkan.physical_device),
            .device = static_cast<VkDevice>(vulkan.device),
            .queue = static_cast<VkQueue>(vulkan.queue),
            .queue_family = vulkan.queue_family,
            .queue_lock = {vulkan.lock_queue, vulkan.unlock_queue, vulkan.queue_user}};
}

vk::raii::PhysicalDevice validated_physical_device(const vk::raii::Instance &instance, const CallerVulkan &caller) {
    const std::vector<vk::raii::PhysicalDevice> devices =
        translated("listing the devices of vulkan.instance", [&] { return instance.enumeratePhysicalDevices(); });
    const auto found = std::ranges::find(devices, vk::PhysicalDevice(caller.physical_device),
                                         [](const vk::raii::PhysicalDevice &device) { return *device; });
    if (found == devices.end())
        refuse_argument("vulkan", "physical_device", pointer_text(caller.physical_device),
                        "must be one of vulkan.instance");
    // This check must come before calls beyond Vulkan 1.0.
    const std::uint32_t device_version = found->getProperties().apiVersion;
    if (device_version >= VK_API_VERSION_1_2 && !offers_version_1_2(instance, caller.device))
        refuse_argument("vulkan", "instance", pointer_text(caller.instance),
                        "must have been created with VkApplicationInfo.apiVersion >= VK_API_VERSION_1_2");
    require_suitable(describe(*found));
    require_compute(found->getQueueFamilyProperties(), caller.queue_family);
    return *found;
}

void require_compute(std::span<const vk::QueueFamilyProperties> families, std::uint32_t queue_family) {
    const std::string value = number_text(queue_family);
    if (queue_family >= families.size())
        refuse_argument("vulkan", "queue_family", value,
                        "must be < " + std::to_string(families.size()) +
                            ", the number of families of vulkan.physical_device");
    if (!(families[queue_family].queueFlags & vk::QueueFlagBits::eCompute))
        refuse_argument("vulkan", "queue_family", value, "must have VK_QUEUE_COMPUTE_BIT");
}

void require_suitable(const pt_device_info &physical_device) {
    if (!physical_device.suitable)
        refuse_argument("vulkan", "physical_device", physical_device.name,
                        std::string("does not fit: ") + physical_device.reason, PT_ERROR_UNSUPPORTED);
}

} // namespace pt::vulkan
