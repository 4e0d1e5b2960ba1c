#pragma once

#include "lib/vulkan/api.h"

#include <pt/devices.h>
#include <pt/pt.h>
#include <pt/vulkan.h>

#include <cstdint>
#include <span>

namespace pt::vulkan {

struct QueueLock {
    pt_queue_fn lock_queue = nullptr;
    pt_queue_fn unlock_queue = nullptr;
    void *user = nullptr;

    void lock() const {
        if (lock_queue)
            lock_queue(user);
    }
    void unlock() const {
        if (unlock_queue)
            unlock_queue(user);
    }
};

struct CallerVulkan {
    VkInstance instance;
    VkPhysicalDevice physical_device;
    VkDevice device;
    VkQueue queue;
    std::uint32_t queue_family;
    QueueLock queue_lock;
};

// Checks the fields without calling Vulkan. Throws PT_ERROR_INVALID_ARGUMENT.
CallerVulkan validated_vulkan(const pt_vulkan &vulkan);

// Throws PT_ERROR_INVALID_ARGUMENT, or PT_ERROR_UNSUPPORTED for unsuitable devices. The caller's instance must outlive
// the result.
vk::raii::PhysicalDevice validated_physical_device(const vk::raii::Instance &instance, const CallerVulkan &caller);

void require_compute(std::span<const vk::QueueFamilyProperties> families, std::uint32_t queue_family);
void require_suitable(const pt_device_info &physical_device);

} // namespace pt::vulkan
