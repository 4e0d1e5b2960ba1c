// A VkDevice and the one queue of it that is used: the library's own, or the caller's.
#pragma once

#include "lib/vulkan/caller_vulkan.h"

#include <chrono>
#include <cstdint>

namespace pt::vulkan {

class LogicalDevice {
public:
    // Creates a device with a queue for compute, and owns it.
    static LogicalDevice create(const vk::raii::PhysicalDevice &physical_device);
    // The caller's, which is left alone.
    static LogicalDevice borrow(const vk::raii::PhysicalDevice &physical_device, const CallerVulkan &caller);
    LogicalDevice(LogicalDevice &&) noexcept = default;
    ~LogicalDevice() {
        if (!is_owned_)
            device_.release();
    }

    const vk::raii::Device &handle() const { return device_; }
    bool is_borrowed() const { return !is_owned_; }
    std::uint32_t queue_family() const { return queue_family_; }

    // Submits to the queue, which it locks for this thread meanwhile. Returns the time at which it got the lock.
    std::chrono::steady_clock::time_point submit(const vk::SubmitInfo &work, vk::Fence fence) const;

    // From now on the device is not destroyed, whoever made it.
    void abandon() { is_owned_ = false; }

private:
    LogicalDevice(vk::raii::Device device, vk::Queue queue, std::uint32_t queue_family, const QueueLock &lock,
                  bool owned);

    vk::raii::Device device_;
    bool is_owned_; // else it is left alone
    vk::raii::Queue queue_;
    std::uint32_t queue_family_;
    QueueLock queue_lock_; // does nothing for the library's own device, whose queue no other thread knows
};

} // namespace pt::vulkan
