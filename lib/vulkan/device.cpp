#include "lib/vulkan/device.h"

#include "lib/base/digest.h"
#include "lib/base/error.h"
#include "lib/vulkan/device_choice.h"
#include "lib/vulkan/logical_device.h"
#include "lib/vulkan/result.h"

#include <algorithm>
#include <charconv>
#include <cstring>
#include <limits>
#include <mutex>
#include <string_view>

namespace pt::vulkan {

namespace {

// llvmpipe before Mesa 25 ends an invocation's loops after this many trips (LP_MAX_TGSI_LOOP_ITERATIONS).
constexpr std::uint64_t llvmpipe_loop_trips = 65'535;
constexpr int first_mesa_without_limit = 25;

// Larger ranges do not help. This range is a multiple of every alignment.
constexpr std::uint32_t largest_uniform_range = 65'536;

// More invocations than a large GPU runs at once.
constexpr std::uint32_t busy_gpu_invocations = 1U << 18;

// Submissions should take only 0.05 seconds.
constexpr std::chrono::seconds gpu_patience{10};
constexpr std::chrono::nanoseconds wait_step = std::chrono::milliseconds{100};

// Longer unrolled code waits for instruction fetches.
constexpr std::uint32_t gpu_unrolled = 16;

constexpr std::uint32_t gpu_walk_trips = 8;

// Far longer than a thread takes to sleep and wake.
constexpr std::chrono::microseconds gpu_polling{300};

// Reads Mesa's version from a text: "Mesa 22.3.6 (LLVM 15.0.6)".
bool ends_loops(const vk::PhysicalDeviceDriverProperties &driver) {
    constexpr std::string_view mesa = "Mesa ";
    const std::string_view info = driver.driverInfo;
    int version = 0;
    if (info.starts_with(mesa))
        std::from_chars(info.data() + mesa.size(), info.data() + info.size(), version);
    return driver.driverID == vk::DriverId::eMesaLlvmpipe && version < first_mesa_without_limit;
}

Limits limits_of(const vk::raii::PhysicalDevice &device) {
    const auto chain = device.getProperties2<vk::PhysicalDeviceProperties2, vk::PhysicalDeviceMaintenance3Properties,
                                             vk::PhysicalDeviceDriverProperties>();
    const vk::PhysicalDeviceLimits &limits = chain.get<vk::PhysicalDeviceProperties2>().properties.limits;
    const bool ends = ends_loops(chain.get<vk::PhysicalDeviceDriverProperties>());
    return {.max_storage_buffer_range = limits.maxStorageBufferRange,
            .max_texel_count = limits.maxTexelBufferElements,
            .max_allocation_bytes = chain.get<vk::PhysicalDeviceMaintenance3Properties>().maxMemoryAllocationSize,
            .max_uniform_range = std::min(limits.maxUniformBufferRange, largest_uniform_range) / 256 * 256,
            .max_workgroup_count = limits.maxComputeWorkGroupCount[0],
            .storage_buffer_alignment = limits.minStorageBufferOffsetAlignment,
            .loop_trip_budget = ends ? llvmpipe_loop_trips : std::numeric_limits<std::uint64_t>::max()};
}

std::array<std::uint32_t, 7> driver_id_of(const vk::raii::PhysicalDevice &device) {
    const vk::PhysicalDeviceProperties properties = device.getProperties();
    std::array<std::uint32_t, 7> id = {properties.vendorID, properties.deviceID, properties.driverVersion};
    static_assert(sizeof properties.pipelineCacheUUID == 4 * sizeof id[0]);
    std::memcpy(&id[3], properties.pipelineCacheUUID.data(), sizeof properties.pipelineCacheUUID);
    return id;
}

using Stage = vk::PipelineStageFlagBits;
using Access = vk::AccessFlagBits;
constexpr vk::PipelineStageFlags device_stages = Stage::eComputeShader | Stage::eTransfer;
constexpr vk::AccessFlags device_writes = Access::eShaderWrite | Access::eTransferWrite;
constexpr vk::AccessFlags device_accesses =
    device_writes | Access::eShaderRead | Access::eUniformRead | Access::eTransferRead;

void write_barrier(const vk::raii::CommandBuffer &commands, vk::PipelineStageFlags stages, vk::AccessFlags accesses) {
    const vk::MemoryBarrier barrier{.srcAccessMask = device_writes, .dstAccessMask = accesses};
    commands.pipelineBarrier(device_stages, stages, {}, barrier, {}, {});
}

double tests_per_second(std::uint32_t kind) {
    switch (kind) {
    case PT_DEVICE_DISCRETE_GPU:
        return 1e10;
    case PT_DEVICE_INTEGRATED_GPU:
        return 1e9;
    default:
        return 2.5e8;
    }
}

} // namespace

DevicePolicy default_policy(const pt_device_info &info) {
    const bool cpu = info.kind == PT_DEVICE_CPU;
    return {.patience = cpu ? std::chrono::nanoseconds::max() : gpu_patience,
            .share_memory = cpu || info.kind == PT_DEVICE_INTEGRATED_GPU,
            .scene_in_constants = cpu,
            .invocations = cpu ? 0U : busy_gpu_invocations,
            .queue_depth = cpu ? 1U : 2U,
            .polling = cpu ? std::chrono::nanoseconds{0} : gpu_polling,
            .tests_per_second = tests_per_second(info.kind),
            .unrolled = cpu ? DevicePolicy{}.unrolled : gpu_unrolled,
            .adaptive_from = cpu ? 0 : DevicePolicy{}.adaptive_from,
            .walk_trips = cpu ? 0 : gpu_walk_trips,
            .compiles_for_cpu = cpu,
            .resolve_on_device = !cpu};
}

DevicePolicy gpu_like_policy() {
    pt_device_info gpu{};
    gpu.kind = PT_DEVICE_DISCRETE_GPU;
    DevicePolicy policy = default_policy(gpu);
    policy.patience = std::chrono::nanoseconds::max();
    policy.tests_per_second = DevicePolicy{}.tests_per_second;
    return policy;
}

Device::Device(Instance &instance, const vk::raii::PhysicalDevice &physical_device, const DevicePolicy &policy,
               const CallerVulkan *caller) :
    instance_(instance),
    info_(describe(physical_device)),
    limits_(limits_of(physical_device)),
    policy_(policy),
    memory_properties_(physical_device.getMemoryProperties()),
    driver_id_(driver_id_of(physical_device)),
    queue_family_(caller ? caller->queue_family : compute_family(physical_device)),
    queue_lock_(caller ? caller->queue_lock : QueueLock()),
    device_{caller ? vk::raii::Device(physical_device, caller->device)
                   : translated("creating the device", [&] { return create_device(physical_device, queue_family_); }),
            caller == nullptr},
    queue_(handle(), caller ? vk::Queue(caller->queue) : *handle().getQueue(queue_family_, 0)) {
    translated("preparing the device", [&] {
        command_pool_ = handle().createCommandPool(
            {.flags = vk::CommandPoolCreateFlagBits::eResetCommandBuffer, .queueFamilyIndex = queue_family_});
        std::vector<vk::raii::CommandBuffer> commands =
            handle().allocateCommandBuffers({.commandPool = *command_pool_,
                                             .level = vk::CommandBufferLevel::ePrimary,
                                             .commandBufferCount = policy_.queue_depth + 2});
        for (vk::raii::CommandBuffer &buffer : commands)
            submissions_.push_back({std::move(buffer), handle().createFence({})});
        pipeline_cache_ = PipelineCache(handle());
    });
}

Device::~Device() {
    if (!abandoned_ && comes_to_rest())
        return;
    // Releases the device instead of destroying it, because vkDestroyDevice may wait forever for running work (NVIDIA
    // 580.159). Destroying the instance before the device would crash.
    pipeline_cache_.abandon();
    for (Submission &submission : submissions_) {
        submission.fence.release();
        submission.commands.release();
    }
    command_pool_.release();
    device_.is_owned = false;
    instance_.abandon();
}

std::string Device::kernel_key(const std::string &code_digest) const {
    Digest digest;
    digest.add(driver_id_);
    digest.add(std::string_view(info_.name));
    digest.add(std::string_view(info_.driver));
    digest.add(code_digest);
    return digest.text();
}

bool Device::hangs() const {
    const auto runs = [&](const Submission &submission) { return !ended(submission); };
    return abandoned_ || (gave_up_ && std::ranges::any_of(submissions_, runs));
}

bool Device::ended(const Submission &submission) const {
    try {
        return !submission.pending || submission.end || submission.fence.getStatus() == vk::Result::eSuccess;
    } catch (const vk::SystemError &) {
        return true;
    }
}

bool Device::is_overdue(const Submission &submission) const {
    return Clock::now() - submission.start > policy_.patience;
}

void Device::require_alive() const {
    if (lost())
        throw Error(PT_ERROR_DEVICE_LOST, lost_message_);
}

// Sets lost_ first, because reason() may throw.
void Device::lose(const std::function<std::string()> &reason) {
    lost_ = true;
    lost_message_ += ": " + reason();
    throw Error(PT_ERROR_DEVICE_LOST, lost_message_);
}

Device::Ticket Device::start(const Record &record, const Semaphores &semaphores) {
    require_alive();
    const auto free = std::ranges::find(submissions_, false, &Submission::pending);
    if (free == submissions_.end())
        throw Error(PT_ERROR_INTERNAL, "too many submissions under way");
    translated("recording work", [&] { record_work(free->commands, record); });
    translated("submitting work", [&] {
        const vk::CommandBuffer commands = *free->commands;
        const vk::PipelineStageFlags waiting_stages = Stage::eComputeShader;
        try {
            const std::lock_guard held(queue_lock_);
            free->start = Clock::now();
            queue_.submit(vk::SubmitInfo{.waitSemaphoreCount = semaphores.wait ? 1U : 0U,
                                         .pWaitSemaphores = &semaphores.wait,
                                         .pWaitDstStageMask = &waiting_stages,
                                         .commandBufferCount = 1,
                                         .pCommandBuffers = &commands,
                                         .signalSemaphoreCount = semaphores.signal ? 1U : 0U,
                                         .pSignalSemaphores = &semaphores.signal},
                          *free->fence);
        } catch (const vk::DeviceLostError &error) {
            comes_to_rest();
            lose([&] { return error.what(); });
        }
    });
    free->pending = true;
    free->last_look = free->start;
    free->end.reset();
    return static_cast<Ticket>(free - submissions_.begin());
}

// Overdue submissions count as done, because finish() does not wait for them.
bool Device::is_done(Ticket ticket, Clock::time_point until) {
    Submission &submission = submissions_[ticket];
    while (!lost() && !is_overdue(submission)) {
        const Clock::time_point now = Clock::now();
        const std::chrono::nanoseconds left = until > now ? until - now : std::chrono::nanoseconds::zero();
        if (look_at(submission, std::min(left, wait_time())))
            return true;
        if (Clock::now() >= until)
            return false;
    }
    return true;
}

void Device::look() {
    for (Submission &submission : submissions_)
        if (!lost() && submission.pending && !submission.end && look_at(submission, std::chrono::nanoseconds::zero()))
            submission.end->earliest = submission.last_look;
}

double Device::finish(Ticket ticket, double expected_seconds) {
    require_alive();
    Submission &submission = submissions_[ticket];
    wait(submission);
    submission.pending = false;
    const Moment end = *submission.end;
    const auto seconds = [](Clock::time_point from, Clock::time_point to) {
        return std::max(std::chrono::duration<double>(to - from).count(), 0.0);
    };
    const double least = seconds(std::max(submission.start, last_end_.latest), end.earliest);
    const double most = seconds(std::max(submission.start, last_end_.earliest), end.latest);
    last_end_ = end;
    return std::clamp(expected_seconds, least, most);
}

bool Device::comes_to_rest() noexcept {
    for (Submission &submission : submissions_) {
        submission.pending = submission.pending && !submission.end;
        try {
            for (bool was_overdue = false; submission.pending; was_overdue = is_overdue(submission)) {
                const auto step = static_cast<std::uint64_t>(wait_time().count());
                submission.pending = handle().waitForFences(*submission.fence, VK_TRUE, step) == vk::Result::eTimeout;
                if (submission.pending && was_overdue) {
                    gave_up_ = true;
                    return false;
                }
            }
        } catch (const vk::DeviceLostError &) {
            submission.pending = false;
        } catch (...) {
            gave_up_ = true;
            return false;
        }
    }
    return true;
}

void Device::record_work(const vk::raii::CommandBuffer &commands, const Record &record) const {
    commands.reset(); // the last recording may have failed
    commands.begin({.flags = vk::CommandBufferUsageFlagBits::eOneTimeSubmit});
    // A submission makes the host's earlier writes visible (Vulkan, "Host Write Ordering Guarantees"). Fences make
    // writes of earlier submissions available, and this barrier makes them visible.
    write_barrier(commands, device_stages, device_accesses);
    record(commands);
    write_barrier(commands, Stage::eHost, Access::eHostRead | Access::eHostWrite);
    commands.end();
}

std::chrono::nanoseconds Device::wait_time() const {
    return std::min(wait_step, policy_.patience);
}

bool Device::look_at(Submission &submission, std::chrono::nanoseconds timeout) {
    if (submission.end)
        return true;
    try {
        const Clock::time_point begin = Clock::now();
        const std::chrono::nanoseconds polling = std::min(policy_.polling, timeout);
        while (Clock::now() - begin < polling && !this->ended(submission)) {
        }
        const std::chrono::nanoseconds left = std::max<std::chrono::nanoseconds>(timeout - (Clock::now() - begin), {});
        const auto nanoseconds = static_cast<std::uint64_t>(left.count());
        const bool ended = handle().waitForFences(*submission.fence, VK_TRUE, nanoseconds) == vk::Result::eSuccess;
        const Clock::time_point now = Clock::now();
        if (ended) {
            handle().resetFences(*submission.fence);
            submission.end = {now, now};
        } else {
            submission.last_look = now;
        }
        return ended;
    } catch (const vk::SystemError &error) {
        // Waits, because callers may destroy objects after the error, and running work may use them.
        comes_to_rest();
        lose([&] { return error.what(); });
    }
}

// Looks once more when the submission is overdue, because it may have ended while this process was stopped.
void Device::wait(Submission &submission) {
    for (bool was_overdue = false; !look_at(submission, wait_time()); was_overdue = is_overdue(submission))
        if (was_overdue) {
            gave_up_ = true;
            lose([&] {
                const auto patience = std::chrono::duration_cast<std::chrono::milliseconds>(policy_.patience);
                return "it did not end a submission within " + std::to_string(patience.count()) + " ms";
            });
        }
}

void barrier_between_commands(const vk::raii::CommandBuffer &commands) {
    write_barrier(commands, device_stages, device_accesses);
}

} // namespace pt::vulkan
