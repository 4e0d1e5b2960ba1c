// Creation of the device, submission and waiting; see device.h.
#include "vulkan/device.h"

#include "error.h"
#include "vulkan/device_choice.h"
#include "vulkan/result.h"

#include <algorithm>
#include <chrono>
#include <cstring>
#include <limits>

namespace pt::vulkan {

namespace {

// Mesa's llvmpipe counts the trips of all loops of an invocation and leaves the loops after this many (Mesa 22.3.6,
// LP_MAX_TGSI_LOOP_ITERATIONS; newer versions do not, and lose little by shorter submissions).
constexpr std::uint64_t llvmpipe_loop_trips = 65'535;

// A GPU that has not finished a submission after so long is taken for lost. Submissions aim at a twentieth of a second.
constexpr std::chrono::seconds gpu_patience{10};
constexpr std::chrono::nanoseconds wait_step = std::chrono::milliseconds{100};

Limits limits_of(const vk::raii::PhysicalDevice &device) {
    const auto chain = device.getProperties2<vk::PhysicalDeviceProperties2, vk::PhysicalDeviceMaintenance3Properties,
                                             vk::PhysicalDeviceDriverProperties>();
    const vk::PhysicalDeviceLimits &limits = chain.get<vk::PhysicalDeviceProperties2>().properties.limits;
    const bool llvmpipe = chain.get<vk::PhysicalDeviceDriverProperties>().driverID == vk::DriverId::eMesaLlvmpipe;
    return {.max_storage_buffer_range = limits.maxStorageBufferRange,
            .max_allocation_bytes = chain.get<vk::PhysicalDeviceMaintenance3Properties>().maxMemoryAllocationSize,
            .max_workgroup_count = limits.maxComputeWorkGroupCount[0],
            .loop_trip_budget = llvmpipe ? llvmpipe_loop_trips : std::numeric_limits<std::uint64_t>::max()};
}

// A family that computes, of those the one that does least else: it is the one for work in the background.
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

vk::raii::Device create_device(const vk::raii::PhysicalDevice &physical_device, std::uint32_t family) {
    // The specification demands that this extension be enabled where it exists.
    constexpr const char *portability_subset = "VK_KHR_portability_subset";
    std::vector<const char *> extensions;
    for (const vk::ExtensionProperties &extension : physical_device.enumerateDeviceExtensionProperties())
        if (std::strcmp(extension.extensionName, portability_subset) == 0)
            extensions.push_back(portability_subset);
    const float priority = 1.0F;
    const vk::DeviceQueueCreateInfo queue{.queueFamilyIndex = family, .queueCount = 1, .pQueuePriorities = &priority};
    return physical_device.createDevice({.queueCreateInfoCount = 1,
                                         .pQueueCreateInfos = &queue,
                                         .enabledExtensionCount = static_cast<std::uint32_t>(extensions.size()),
                                         .ppEnabledExtensionNames = extensions.data()});
}

void memory_barrier(const vk::raii::CommandBuffer &commands, vk::PipelineStageFlags from, vk::AccessFlags written,
                    vk::PipelineStageFlags to, vk::AccessFlags accessed) {
    const vk::MemoryBarrier barrier{.srcAccessMask = written, .dstAccessMask = accessed};
    commands.pipelineBarrier(from, to, {}, barrier, {}, {});
}

using Stage = vk::PipelineStageFlagBits;
using Access = vk::AccessFlagBits;
constexpr vk::AccessFlags kernel_access = Access::eShaderRead | Access::eShaderWrite;
constexpr vk::AccessFlags transfer_access = Access::eTransferRead | Access::eTransferWrite;

} // namespace

Device::Device(const vk::raii::PhysicalDevice &physical_device) :
    info_(describe(physical_device)), limits_(limits_of(physical_device)),
    memory_properties_(physical_device.getMemoryProperties()) {
    translated("creating the device", [&] {
        const std::uint32_t family = compute_family(physical_device);
        device_ = create_device(physical_device, family);
        queue_ = device_.getQueue(family, 0);
        command_pool_ = device_.createCommandPool(
            {.flags = vk::CommandPoolCreateFlagBits::eResetCommandBuffer, .queueFamilyIndex = family});
        commands_ = std::move(device_.allocateCommandBuffers({.commandPool = *command_pool_,
                                                              .level = vk::CommandBufferLevel::ePrimary,
                                                              .commandBufferCount = 1})[0]);
        fence_ = device_.createFence({});
        pipeline_cache_ = device_.createPipelineCache({});
    });
}

Device::~Device() {
    // Every submission has been waited for, except one that a GPU never finished: its objects are left to the driver,
    // which may not be asked to wait for what does not end.
    if (lost())
        return;
    try {
        device_.waitIdle();
    } catch (const vk::SystemError &) { // nothing is left to be told to anybody
    }
}

void Device::require_alive() const {
    if (lost())
        throw Error(PT_ERROR_DEVICE_LOST, lost_message_);
}

void Device::lose(const std::string &message) {
    lost_message_ = std::string("the device was lost: ") + message;
    throw Error(PT_ERROR_DEVICE_LOST, lost_message_);
}

double Device::submit(const std::function<void(const vk::raii::CommandBuffer &)> &record) {
    require_alive();
    try {
        commands_.begin({.flags = vk::CommandBufferUsageFlagBits::eOneTimeSubmit});
        memory_barrier(commands_, Stage::eComputeShader | Stage::eTransfer, Access::eShaderWrite | Access::eTransferWrite,
                       Stage::eComputeShader | Stage::eTransfer, kernel_access | transfer_access);
        record(commands_);
        memory_barrier(commands_, Stage::eComputeShader | Stage::eTransfer, Access::eShaderWrite | Access::eTransferWrite,
                       Stage::eHost, Access::eHostRead | Access::eHostWrite);
        commands_.end();
        const auto start = std::chrono::steady_clock::now();
        const vk::CommandBuffer commands = *commands_;
        queue_.submit(vk::SubmitInfo{.commandBufferCount = 1, .pCommandBuffers = &commands}, *fence_);
        wait();
        return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
    } catch (const vk::DeviceLostError &error) {
        lose(error.what());
    } catch (const vk::SystemError &error) {
        throw Error(result_of(static_cast<vk::Result>(error.code().value())),
                    std::string("submitting work: ") + error.what());
    }
}

void Device::wait() {
    const bool patient = info_.kind == PT_DEVICE_CPU; // a loaded machine may take any time
    const auto start = std::chrono::steady_clock::now();
    while (device_.waitForFences(*fence_, VK_TRUE, static_cast<std::uint64_t>(wait_step.count())) ==
           vk::Result::eTimeout)
        if (!patient && std::chrono::steady_clock::now() - start > gpu_patience)
            lose("a submission did not end within " + std::to_string(gpu_patience.count()) + " s");
    device_.resetFences(*fence_);
}

void barrier_between_dispatches(const vk::raii::CommandBuffer &commands) {
    memory_barrier(commands, Stage::eComputeShader, Access::eShaderWrite, Stage::eComputeShader, kernel_access);
}

} // namespace pt::vulkan
