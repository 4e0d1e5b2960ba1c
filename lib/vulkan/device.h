// A logical device with its one compute queue. Owned by Renderer; buffers and pipelines are made on it.
#pragma once

#include "vulkan/instance.h"

#include <pt/pt.h>

#include <chrono>
#include <cstdint>
#include <functional>
#include <string>

namespace pt::vulkan {

struct Limits {
    std::uint64_t max_storage_buffer_range; // bytes that one binding can see
    std::uint64_t max_allocation_bytes;
    std::uint32_t max_uniform_range;   // bytes that a uniform binding can see: 16 to 64 KiB, a multiple of 256
    std::uint32_t max_workgroup_count; // along x
    std::uint64_t loop_trip_budget;    // loop trips after which the driver stops an invocation, without a word
};

// How a device is used. Tests choose other than the default, to reach what their device alone would not show.
struct DevicePolicy {
    std::chrono::nanoseconds patience; // a submission that takes longer means that the device is lost
    bool share_memory;                 // the host reads and writes buffers in place where their memory is fast for both
    bool scene_in_constants; // kernels run faster with the scene's numbers compiled in than read from a buffer
};

DevicePolicy default_policy(const pt_device_info &info);

class Device {
public:
    // The instance must outlive the device. A device that hangs is left to the end of the process, and its instance too.
    Device(Instance &instance, const vk::raii::PhysicalDevice &physical_device);
    Device(Instance &instance, const vk::raii::PhysicalDevice &physical_device, const DevicePolicy &policy);
    ~Device();
    Device(const Device &) = delete;
    Device &operator=(const Device &) = delete;

    const pt_device_info &info() const { return info_; }
    const Limits &limits() const { return limits_; }
    const DevicePolicy &policy() const { return policy_; }
    std::uint64_t allocated_bytes() const { return allocated_bytes_; }
    bool lost() const { return !lost_message_.empty(); }

    // Throws PT_ERROR_DEVICE_LOST, with the message of the first loss, from the moment that the device was lost.
    void require_alive() const;

    // Records commands, submits them, waits, and returns the seconds from submission to completion. What earlier
    // submissions wrote is visible to the commands, and what they write is visible to the host.
    double submit(const std::function<void(const vk::raii::CommandBuffer &)> &record);

    const vk::raii::Device &handle() const { return device_; }
    const vk::raii::PipelineCache &pipeline_cache() const { return pipeline_cache_; }
    const vk::PhysicalDeviceMemoryProperties &memory_properties() const { return memory_properties_; }
    void count_allocation(std::uint64_t bytes) { allocated_bytes_ += bytes; }
    void count_release(std::uint64_t bytes) { allocated_bytes_ -= bytes; }

private:
    void record_work(const std::function<void(const vk::raii::CommandBuffer &)> &record);
    void wait(std::chrono::steady_clock::time_point start);
    bool ended() const;
    [[noreturn]] void lose(const std::string &message);

    Instance &instance_;
    pt_device_info info_;
    Limits limits_;
    DevicePolicy policy_;
    vk::PhysicalDeviceMemoryProperties memory_properties_;
    vk::raii::Device device_ = nullptr;
    vk::raii::Queue queue_ = nullptr;
    vk::raii::CommandPool command_pool_ = nullptr;
    vk::raii::CommandBuffer commands_ = nullptr;
    vk::raii::Fence fence_ = nullptr;
    vk::raii::PipelineCache pipeline_cache_ = nullptr;
    std::uint64_t allocated_bytes_ = 0;
    std::string lost_message_;
    bool pending_ = false; // the end of a submission was not seen
};

// Makes what the dispatches before it wrote visible to those after it.
void barrier_between_dispatches(const vk::raii::CommandBuffer &commands);

} // namespace pt::vulkan
