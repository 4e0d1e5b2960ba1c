#pragma once

#include "lib/vulkan/caller_vulkan.h"
#include "lib/vulkan/instance.h"
#include "lib/vulkan/pipeline_cache.h"

#include <pt/devices.h>
#include <pt/pt.h>

#include <array>
#include <chrono>
#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <vector>

namespace pt::vulkan {

struct Limits {
    std::uint64_t max_storage_buffer_range;
    std::uint64_t max_texel_count;
    std::uint64_t max_allocation_bytes;
    std::uint32_t max_uniform_range;
    std::uint32_t max_workgroup_count;
    std::uint64_t storage_buffer_alignment;
    std::uint64_t loop_trip_budget; // the driver silently ends longer loops
};

struct DevicePolicy {
    std::chrono::nanoseconds patience;
    bool share_memory;
    bool scene_in_constants;
    std::uint32_t invocations; // enough to keep the device busy; 0: any number
    std::uint32_t queue_depth; // submissions in flight; 2 if the device would idle between them
    // Time of active waiting before the thread sleeps.
    std::chrono::nanoseconds polling{0};
    // Rate assumed for the first slice. All devices of this kind are faster.
    double tests_per_second = 2.5e8;
    // Loops over up to this many surfaces are unrolled. A tree replaces longer loops on CPUs.
    std::uint32_t unrolled = 112;
    // Adaptive sampling starts at this many samples per pixel, or four times as many for paths of two vertices. Earlier
    // checks cost a GPU more time than they save. 0, or a power of two >= 16.
    std::uint32_t adaptive_from = 256;
    std::uint32_t walk_trips = 0; // WALK_TRIPS in specialization.h
    // Use integer comparisons (maths.glsl) and uniform buffers, which are faster on CPUs.
    bool compiles_for_cpu = false;
    bool resolve_on_device = false;
};

DevicePolicy default_policy(const pt_device_info &info);

// Makes a CPU use the code paths for GPUs, without a time limit.
DevicePolicy gpu_like_policy();

// Binary semaphores or null. A submission waits for the first and signals the second.
struct Semaphores {
    vk::Semaphore wait;
    vk::Semaphore signal;
};

class Device {
public:
    // The instance must outlive the device. If the device hangs, neither is destroyed. If `caller` is NULL, the library
    // creates its own device.
    Device(Instance &instance, const vk::raii::PhysicalDevice &physical_device, const DevicePolicy &policy,
           const CallerVulkan *caller = nullptr);
    ~Device();
    Device(const Device &) = delete;
    Device &operator=(const Device &) = delete;

    const Log &log() const { return instance_.log(); }
    const pt_device_info &info() const { return info_; }
    const Limits &limits() const { return limits_; }
    const DevicePolicy &policy() const { return policy_; }
    std::uint64_t allocated_bytes() const { return allocated_bytes_; }

    // Must be checked before large allocations, because drivers may allocate memory that fails when it is used.
    bool has_memory(std::uint64_t bytes) const { return bytes <= info_.memory_bytes; }

    bool lost() const { return lost_; }

    // Whether abandoned or overdue work may be running. Objects that it uses must not be destroyed.
    bool hangs() const;

    // The device and its objects will not be destroyed.
    void abandon() noexcept { abandoned_ = true; }

    // Throws PT_ERROR_DEVICE_LOST if the device is lost.
    void require_alive() const;

    using Record = std::function<void(const vk::raii::CommandBuffer &)>;
    using Ticket = std::uint32_t;

    // Submissions run in order and see earlier writes. The host sees writes after finish(). At most queue_depth + 2 may
    // be in flight: one more for submit(), and one for pt_readback_to_buffer.
    Ticket start(const Record &record, const Semaphores &semaphores = {});

    using Clock = std::chrono::steady_clock;

    // Waits until the given time at most. Returns whether finish() would return at once.
    bool is_done(Ticket ticket, Clock::time_point until);

    // Notes which submissions have ended, so that finish() returns more exact times.
    void look();

    // Waits for a submission. Returns the seconds since its start or, if later, the end of the previous submission. If
    // only bounds are known, returns the value within them nearest to expected_seconds.
    double finish(Ticket ticket, double expected_seconds = 0.0);

    // Waits for all running work, also after finish() failed. Returns false if it takes longer than
    // DevicePolicy::patience.
    bool comes_to_rest() noexcept;

    double submit(const Record &record) { return finish(start(record)); }

    const vk::raii::Device &handle() const { return device_.handle; }
    bool is_borrowed() const { return !device_.is_owned; }
    PipelineCache &pipeline_cache() { return pipeline_cache_; }

    // Returns 32 hexadecimal digits that depend on device model, driver and code.
    std::string kernel_key(const std::string &code_digest) const;

    const vk::PhysicalDeviceMemoryProperties &memory_properties() const { return memory_properties_; }
    void count_allocation(std::uint64_t bytes) { allocated_bytes_ += bytes; }
    void count_release(std::uint64_t bytes) { allocated_bytes_ -= bytes; }

private:
    struct OwnedOrLent {
        vk::raii::Device handle;
        bool is_owned;

        ~OwnedOrLent() {
            if (!is_owned)
                handle.release();
        }
    };

    struct Moment {
        Clock::time_point earliest;
        Clock::time_point latest;
    };

    struct Submission {
        vk::raii::CommandBuffer commands;
        vk::raii::Fence fence;
        bool pending = false; // finish() has not been called yet
        Clock::time_point start{};
        Clock::time_point last_look{};
        std::optional<Moment> end{};
    };

    void record_work(const vk::raii::CommandBuffer &commands, const Record &record) const;
    std::chrono::nanoseconds wait_time() const;
    bool look_at(Submission &submission, std::chrono::nanoseconds timeout);
    void wait(Submission &submission);
    bool ended(const Submission &submission) const;
    bool is_overdue(const Submission &submission) const;
    [[noreturn]] void lose(const std::function<std::string()> &reason);

    Instance &instance_;
    pt_device_info info_;
    Limits limits_;
    DevicePolicy policy_;
    vk::PhysicalDeviceMemoryProperties memory_properties_;
    std::array<std::uint32_t, 7> driver_id_;
    std::uint32_t queue_family_;
    QueueLock queue_lock_;
    OwnedOrLent device_;
    vk::raii::Queue queue_;
    vk::raii::CommandPool command_pool_ = nullptr;
    std::vector<Submission> submissions_;
    Moment last_end_{};
    PipelineCache pipeline_cache_;
    std::uint64_t allocated_bytes_ = 0;
    std::string lost_message_ = "the device was lost";
    bool lost_ = false;
    bool gave_up_ = false; // an overdue submission may still be running
    bool abandoned_ = false;
};

void barrier_between_commands(const vk::raii::CommandBuffer &commands);

} // namespace pt::vulkan
