// A logical device, which runs submissions in order.
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
    std::uint64_t max_storage_buffer_range; // bytes per binding
    std::uint64_t max_texel_count;          // per binding
    std::uint64_t max_allocation_bytes;
    std::uint32_t max_uniform_range;        // per binding, a multiple of 256
    std::uint32_t max_workgroup_count;      // along x
    std::uint64_t storage_buffer_alignment; // bytes
    std::uint64_t loop_trip_budget;         // the driver silently stops an invocation after these
};

// How a device is used. Tests override it.
struct DevicePolicy {
    std::chrono::nanoseconds patience; // longer submissions mean a lost device
    bool share_memory;                 // the host accesses buffers in place where their memory is fast for both
    bool scene_in_constants;           // faster compiled in than in a buffer
    std::uint32_t invocations;         // enough to keep it busy; 0: any number
    std::uint32_t queue_depth;         // submissions to keep running; 2 if the device would idle between them
    // Before sleeping.
    std::chrono::nanoseconds polling{0};
    // Ray-surface tests that every such device achieves. Sizes the first slice.
    double tests_per_second = 2.5e8;
    // Loops over up to this many surfaces are unrolled. The default is for CPUs, where a tree beats longer loops.
    std::uint32_t unrolled = 112;
    // Samples per pixel from which tiles may differ (lib/film/adaptive_rule.h); four times as many for paths of two
    // vertices. Earlier checks cost a GPU more than they save. 0, or a power of two >= 16.
    std::uint32_t adaptive_from = 256;
    std::uint32_t walk_trips = 0; // ID_WALK_TRIPS, in scenes with a tree
    // Comparisons of integers (shaders/maths.glsl) and uniform buffers are then faster.
    bool compiles_for_cpu = false;
    bool resolve_on_device = false; // images and error estimates are faster there than on the host
};

DevicePolicy default_policy(const pt_device_info &info);

// A GPU's code paths on a CPU, with endless patience.
DevicePolicy gpu_like_policy();

// Binary semaphores or null: waited for before the kernels, signalled at the end.
struct Semaphores {
    vk::Semaphore wait;
    vk::Semaphore signal;
};

class Device {
public:
    // The instance must outlive the device. Neither is destroyed if the device hangs. caller: lends device and queue;
    // NULL: the library's own.
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

    // Whether the device has this much memory in all. Ask before large allocations: drivers may promise memory that
    // fails when touched.
    bool has_memory(std::uint64_t bytes) const { return bytes <= info_.memory_bytes; }

    bool lost() const { return lost_; }

    // Whether work that was given up or abandoned is running. Nothing that it uses may be destroyed.
    bool hangs() const;

    // Keeps the device and everything on it from being destroyed.
    void abandon() noexcept { abandoned_ = true; }

    // Throws PT_ERROR_DEVICE_LOST with the message of the loss.
    void require_alive() const;

    using Record = std::function<void(const vk::raii::CommandBuffer &)>;
    using Ticket = std::uint32_t;

    // Records and submits commands. Submissions run in order and see earlier ones' writes; the host sees theirs after
    // finish(). At most queue_depth may be running, besides one of submit() and one for a caller who waits on the
    // device.
    Ticket start(const Record &record, const Semaphores &semaphores = {});

    using Clock = std::chrono::steady_clock;

    // Waits until then; returns whether finish() would return at once.
    bool is_done(Ticket ticket, Clock::time_point until);

    // Notes which submissions have ended, to bound their times.
    void look();

    // Whether all submissions have ended, waited for or not.
    bool is_at_rest() const;

    // Waits for a submission. Returns its seconds, counted from the previous one's end if that is later. If the end is
    // known within bounds only, takes the value nearest to expected_seconds.
    double finish(Ticket ticket, double expected_seconds = 0.0);

    // Waits for all running work, also after finish() failed. False if it outlasts the device's patience.
    bool comes_to_rest() noexcept;

    double submit(const Record &record) { return finish(start(record)); }

    const vk::raii::Device &handle() const { return device_.handle; }
    bool is_borrowed() const { return !device_.is_owned; }
    PipelineCache &pipeline_cache() { return pipeline_cache_; }

    // 32 hexadecimal digits for device model, driver and code.
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
        bool pending = false; // finish() has not been called
        Clock::time_point start{};
        Clock::time_point last_look{}; // the last look that found it unfinished
        std::optional<Moment> end{};
    };

    void record_work(const vk::raii::CommandBuffer &commands, const Record &record) const;
    std::chrono::nanoseconds wait_time() const; // the longest single wait
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
    QueueLock queue_lock_; // no-op for the device's own queue
    OwnedOrLent device_;
    vk::raii::Queue queue_;
    vk::raii::CommandPool command_pool_ = nullptr;
    std::vector<Submission> submissions_;
    Moment last_end_{};
    PipelineCache pipeline_cache_;
    std::uint64_t allocated_bytes_ = 0;
    std::string lost_message_ = "the device was lost";
    bool lost_ = false;
    bool gave_up_ = false; // a submission whose end was not seen
    bool abandoned_ = false;
};

// Makes earlier commands' writes visible to later ones.
void barrier_between_commands(const vk::raii::CommandBuffer &commands);

} // namespace pt::vulkan
