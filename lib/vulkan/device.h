// A logical device: submits work to it, in order, and waits for it. Owned by RenderDevice; buffers and pipelines are
// made on it.
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
    std::uint64_t max_storage_buffer_range; // bytes that one binding can see
    std::uint64_t max_texel_count;          // that one binding can see
    std::uint64_t max_allocation_bytes;
    std::uint32_t max_uniform_range;        // bytes that a uniform binding can see: 16 to 64 KiB, a multiple of 256
    std::uint32_t max_workgroup_count;      // along x
    std::uint64_t storage_buffer_alignment; // offsets of bindings are multiples of it, bytes
    std::uint64_t loop_trip_budget;         // loop trips after which the driver silently stops an invocation
};

// How a device is used. Tests choose other values than a device's own, to reach paths that it would not take.
struct DevicePolicy {
    std::chrono::nanoseconds patience; // if a submission takes longer, the device is lost
    bool share_memory;                 // the host reads and writes buffers in place where their memory is fast for both
    bool scene_in_constants;   // kernels run faster with the scene's numbers compiled in than read from a buffer
    std::uint32_t invocations; // so many keep it busy; 0: any number does
    std::uint32_t queue_depth; // submissions to have under way: 2 where it would idle while the host prepares the next
    // How long a submission is polled before the thread sleeps: falling asleep and waking take longer than many
    // submissions.
    std::chrono::nanoseconds polling{0};
    // Ray-surface tests a second that any such device manages. It sizes the first slice; measured times size the
    // others. The default is an eighth of what two CPU cores do.
    double tests_per_second = 2.5e8;
    // Loops over up to so many surfaces are unrolled. The default is for CPUs: lavapipe reads constant places once for
    // all invocations, which makes 60 spheres twice as fast as a tree over them with vectors of 512 bits and 1.3 times
    // with 256; 100 spheres 1.3 and 1.0 times at path length 3, 1.7 and 1.2 times at 6. Each surface takes 10
    // milliseconds to compile, which sets the limit.
    std::uint32_t unrolled = 112;
    // Number of samples of a pixel from which on tiles may get different numbers (lib/film/adaptive_rule.h); four times
    // as many with paths of two vertices. On GPUs a check of the error takes as long as some samples, so pictures that
    // need few samples are done sooner without checks. 0, or a power of two >= 16.
    std::uint32_t adaptive_from = 256;
    std::uint32_t walk_trips = 0; // specialization constant ID_WALK_TRIPS, in scenes with a tree
    // Kernels run faster if they compare integers instead of floats (shaders/maths.glsl), and if values that differ
    // between invocations are read from uniform buffers instead of storage buffers.
    bool compiles_for_cpu = false;
    bool resolve_on_device = false; // kernels make images and error estimates of a film faster than the host does
};

DevicePolicy default_policy(const pt_device_info &info);

// A GPU's policy, but with endless patience and a CPU's tests_per_second: tests reach on a CPU what only GPUs do.
DevicePolicy gpu_like_policy();

// Binary semaphores of a submission, or none: it waits before its kernels, and signals at its end.
struct Semaphores {
    vk::Semaphore wait;
    vk::Semaphore signal;
};

class Device {
public:
    // The instance must outlive the device. A device that hangs is never destroyed, nor is its instance: both stay
    // until the process ends.
    // caller: whose device and queue are used, and left alone; NULL for a device of its own.
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

    // Whether the device has at least so much memory, including what is in use. Drivers may promise memory that they do
    // not have and fail when it is touched, so ask this before allocating much.
    bool has_memory(std::uint64_t bytes) const { return bytes <= info_.memory_bytes; }

    bool lost() const { return lost_; }

    // Whether submissions that were given up are still under way, or were when the device was abandoned. If so, what
    // they use must not be destroyed.
    bool hangs() const;

    // From now on neither the device nor anything on it is destroyed: they stay until the process ends.
    void abandon() noexcept { abandoned_ = true; }

    // Throws PT_ERROR_DEVICE_LOST, with the message of the first loss, once the device is lost.
    void require_alive() const;

    using Record = std::function<void(const vk::raii::CommandBuffer &)>;
    using Ticket = std::uint32_t;

    // Records commands and submits them. What earlier submissions wrote is visible to the commands, and what they write
    // is visible to the host after finish(). Submissions run in order. At most queue_depth may be under way, besides
    // one of submit() and one for a caller who waits on the device.
    Ticket start(const Record &record, const Semaphores &semaphores = {});

    using Clock = std::chrono::steady_clock;

    // Waits until a submission ends, but no longer than until the given time. Returns whether finish() would return at
    // once.
    bool is_done(Ticket ticket, Clock::time_point until);

    // Notes which submissions have ended while nobody waited. All that is known about the times of their ends is that
    // they lie between the last look and this one.
    void look();

    // Whether all submissions have ended, waited for or not.
    bool is_at_rest() const;

    // Waits for a submission. Returns the seconds from its start, or from the end of the one before if that was later,
    // to its end; if ends are known only within bounds, the possible value nearest to the expected seconds.
    double finish(Ticket ticket, double expected_seconds = 0.0);

    // Waits for everything under way, also after finish() failed. False if it does not end within the device's
    // patience.
    bool comes_to_rest() noexcept;

    // Starts a submission and waits for it.
    double submit(const Record &record) { return finish(start(record)); }

    const vk::raii::Device &handle() const { return device_.handle; }
    bool is_borrowed() const { return !device_.is_owned; }
    PipelineCache &pipeline_cache() { return pipeline_cache_; }

    // The key under which the driver's kernels of some code are kept: it stands for this model of device, its driver
    // and that code. 32 hexadecimal digits.
    std::string kernel_key(const std::string &code_digest) const;

    const vk::PhysicalDeviceMemoryProperties &memory_properties() const { return memory_properties_; }
    void count_allocation(std::uint64_t bytes) { allocated_bytes_ += bytes; }
    void count_release(std::uint64_t bytes) { allocated_bytes_ -= bytes; }

private:
    struct OwnedOrLent {
        vk::raii::Device handle;
        bool is_owned; // else it is left alone

        ~OwnedOrLent() {
            if (!is_owned)
                handle.release();
        }
    };

    // When something happened, as far as that is known.
    struct Moment {
        Clock::time_point earliest;
        Clock::time_point latest;
    };

    // Commands that are under way, or may be used again.
    struct Submission {
        vk::raii::CommandBuffer commands;
        vk::raii::Fence fence;
        bool pending = false; // finish() has not been called yet
        Clock::time_point start{};
        Clock::time_point last_look{}; // the last one that found it unfinished
        std::optional<Moment> end{};   // set once the end has been seen
    };

    void record_work(const vk::raii::CommandBuffer &commands, const Record &record) const;
    std::chrono::nanoseconds wait_time() const; // at a time
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
    std::array<std::uint32_t, 7> driver_id_; // numbers that tell drivers and models of devices apart
    std::uint32_t queue_family_;
    QueueLock queue_lock_; // does nothing for the device's own queue, which no other thread knows
    OwnedOrLent device_;
    vk::raii::Queue queue_;
    vk::raii::CommandPool command_pool_ = nullptr;
    std::vector<Submission> submissions_;
    Moment last_end_{};
    PipelineCache pipeline_cache_;
    std::uint64_t allocated_bytes_ = 0;
    std::string lost_message_ = "the device was lost";
    bool lost_ = false;
    bool gave_up_ = false; // gave up a submission whose end was not seen
    bool abandoned_ = false;
};

// Records a barrier that makes what earlier commands wrote visible to later ones.
void barrier_between_commands(const vk::raii::CommandBuffer &commands);

} // namespace pt::vulkan
