// A VkDevice with the one queue of it that is used: made by the library, or the caller's.
#pragma once

#include "lib/vulkan/borrowable.h"
#include "lib/vulkan/caller_vulkan.h"

#include <chrono>
#include <cstdint>

namespace pt::vulkan {

class LogicalDevice {
public:
    // A new one, owned, with a queue that computes.
    static LogicalDevice create(const vk::raii::PhysicalDevice &physical_device);
    // The caller's, which is left alone.
    static LogicalDevice borrow(const vk::raii::PhysicalDevice &physical_device, const CallerVulkan &caller);

    const vk::raii::Device &handle() const { return *device_; }
    bool is_borrowed() const { return !device_.is_owned(); }
    std::uint32_t queue_family() const { return queue_family_; }

    // Submits to the queue, and locks it for this thread meanwhile. Returns the time at which it had the lock.
    std::chrono::steady_clock::time_point submit(const vk::SubmitInfo &work, vk::Fence fence) const;

    // From now on the device is not destroyed, whoever made it.
    void abandon() { device_.disown(); }

private:
    LogicalDevice(Borrowable<vk::raii::Device> device, vk::raii::Queue queue, std::uint32_t queue_family,
                  QueueLock queue_lock);

    Borrowable<vk::raii::Device> device_;
    vk::raii::Queue queue_;
    std::uint32_t queue_family_;
    QueueLock queue_lock_; // does nothing where the device is the library's own: no other thread knows its queue
};

} // namespace pt::vulkan
