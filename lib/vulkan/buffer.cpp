#include "lib/vulkan/buffer.h"

#include "lib/vulkan/device_object.h"
#include "lib/vulkan/memory_type.h"
#include "lib/vulkan/result.h"

#include <algorithm>
#include <array>
#include <cstring>
#include <numeric>
#include <optional>
#include <vector>

namespace pt::vulkan {

namespace {

using Property = vk::MemoryPropertyFlagBits;
using Usage = vk::BufferUsageFlagBits;
constexpr vk::MemoryPropertyFlags host_visible = Property::eHostVisible | Property::eHostCoherent;
constexpr vk::MemoryPropertyFlags host_readable = host_visible | Property::eHostCached;

// Copying this much takes far longer than a submission's overhead.
constexpr std::uint64_t max_staging_bytes = 16U << 20;

struct Allocation {
    Allocation(const Device &device, std::uint64_t bytes, vk::BufferUsageFlags usage,
               std::span<const vk::MemoryPropertyFlags> wanted_best_first,
               std::optional<vk::MemoryPropertyFlags> mapped_if) :
        buffer(device, device.handle().createBuffer({.size = bytes, .usage = usage})) {
        const vk::MemoryRequirements needs = buffer->getMemoryRequirements();
        const vk::PhysicalDeviceMemoryProperties &types = device.memory_properties();
        std::uint32_t type = 0;
        memory = {device,
                  allocate_where_there_is_room(memory_types(types, needs.memoryTypeBits, wanted_best_first),
                                               [&](std::uint32_t candidate) {
                                                   type = candidate;
                                                   return device.handle().allocateMemory(
                                                       {.allocationSize = needs.size, .memoryTypeIndex = candidate});
                                               })};
        buffer->bindMemory(*memory, 0);
        if (mapped_if && (types.memoryTypes[type].propertyFlags & *mapped_if) == *mapped_if)
            mapped = static_cast<std::byte *>(memory->mapMemory(0, VK_WHOLE_SIZE));
    }

    DeviceObject<vk::raii::DeviceMemory> memory;
    DeviceObject<vk::raii::Buffer> buffer;
    std::byte *mapped = nullptr;
};

Allocation allocate(const Device &device, BufferUse use, std::uint64_t bytes) {
    if (use == BufferUse::Streamed || use == BufferUse::HostWritten) {
        constexpr std::array wanted = {Property::eDeviceLocal | host_visible, host_visible};
        const auto usage = use == BufferUse::Streamed ? Usage::eUniformBuffer : Usage::eStorageBuffer;
        return {device, bytes, usage, wanted, host_visible};
    }
    if (use == BufferUse::HostRead) {
        constexpr std::array wanted = {host_readable, host_visible};
        return {device, bytes, Usage::eStorageBuffer | Usage::eTransferDst, wanted, host_visible};
    }
    vk::BufferUsageFlags usage = Usage::eStorageBuffer | Usage::eTransferSrc | Usage::eTransferDst;
    if (use == BufferUse::UniformOrStorage)
        usage |= Usage::eUniformBuffer | Usage::eUniformTexelBuffer;
    if (use == BufferUse::Texels)
        usage |= Usage::eUniformTexelBuffer;
    if (device.policy().share_memory) {
        constexpr std::array<vk::MemoryPropertyFlags, 3> wanted = {Property::eDeviceLocal | host_readable,
                                                                   Property::eDeviceLocal, vk::MemoryPropertyFlags{}};
        return {device, bytes, usage, wanted, host_readable};
    }
    constexpr std::array<vk::MemoryPropertyFlags, 2> wanted = {Property::eDeviceLocal, vk::MemoryPropertyFlags{}};
    return {device, bytes, usage, wanted, std::nullopt};
}

Allocation allocate_staging(const Device &device, std::uint64_t bytes) {
    constexpr std::array wanted = {host_readable, host_visible};
    return {device, bytes, Usage::eTransferSrc | Usage::eTransferDst, wanted, host_visible};
}

} // namespace

struct Buffer::State {
    State(Device &device_of_it, BufferUse use, std::uint64_t size) :
        device(device_of_it),
        bytes(size),
        allocation(allocate(device, use, bytes)) {
        device.count_allocation(bytes);
    }
    ~State() { device.count_release(bytes + (staging ? staging_bytes() : 0)); }
    State(const State &) = delete;
    State &operator=(const State &) = delete;

    template <typename Function>
    void staged(std::uint64_t size, Function &&function) {
        const std::uint64_t piece = staging_bytes();
        if (!staging) {
            translated("allocating " + std::to_string(piece) + " bytes for transfers",
                       [&] { staging.emplace(allocate_staging(device, piece)); });
            device.count_allocation(piece);
        }
        for (std::uint64_t first = 0; first < size; first += piece)
            function(*staging, first, std::min(size - first, piece));
    }

    std::uint64_t staging_bytes() const { return std::min(bytes, max_staging_bytes); }

    Device &device;
    std::uint64_t bytes;
    Allocation allocation;
    std::optional<Allocation> staging;
};

Buffer::Buffer(Device &device, BufferUse use, std::uint64_t bytes, const std::string &what) {
    device.require_alive();
    const std::string doing = "allocating " + std::to_string(bytes) + " bytes for the " + what;
    const std::uint64_t limit = device.limits().max_allocation_bytes;
    if (bytes > limit)
        throw Error(PT_ERROR_OUT_OF_DEVICE_MEMORY,
                    doing + ": the device allows " + std::to_string(limit) + " in one allocation");
    state_ = translated(doing, [&] { return std::make_unique<State>(device, use, bytes); });
}

Buffer::~Buffer() = default;
Buffer::Buffer(Buffer &&other) noexcept = default;
Buffer &Buffer::operator=(Buffer &&other) noexcept = default;

std::uint64_t Buffer::size() const {
    return state_->bytes;
}

vk::Buffer Buffer::handle() const {
    return *state_->allocation.buffer;
}

void Buffer::upload(std::span<const std::byte> data, std::uint64_t offset) {
    state_->device.require_alive();
    if (data.empty())
        return;
    if (state_->allocation.mapped) {
        std::memcpy(state_->allocation.mapped + offset, data.data(), data.size());
        return;
    }
    state_->staged(data.size(), [&](const Allocation &staging, std::uint64_t first, std::uint64_t length) {
        std::memcpy(staging.mapped, data.data() + first, length);
        const vk::BufferCopy copy{.srcOffset = 0, .dstOffset = offset + first, .size = length};
        state_->device.submit(
            [&](const vk::raii::CommandBuffer &commands) { commands.copyBuffer(*staging.buffer, handle(), copy); });
    });
}

void Buffer::download(std::span<std::byte> data, std::uint64_t offset) {
    state_->device.require_alive();
    if (data.empty())
        return;
    if (state_->allocation.mapped) {
        std::memcpy(data.data(), state_->allocation.mapped + offset, data.size());
        return;
    }
    state_->staged(data.size(), [&](const Allocation &staging, std::uint64_t first, std::uint64_t length) {
        const vk::BufferCopy copy{.srcOffset = offset + first, .dstOffset = 0, .size = length};
        state_->device.submit(
            [&](const vk::raii::CommandBuffer &commands) { commands.copyBuffer(handle(), *staging.buffer, copy); });
        std::memcpy(data.data() + first, staging.mapped, length);
    });
}

void Buffer::download(std::span<const BufferPiece> pieces) {
    const bool fit_together =
        std::accumulate(pieces.begin(), pieces.end(), std::uint64_t{0},
                        [](auto sum, auto &piece) { return sum + piece.data.size(); }) <= state_->staging_bytes();
    if (state_->allocation.mapped || !fit_together) {
        for (const BufferPiece &piece : pieces)
            download(piece.data, piece.offset);
        return;
    }
    std::vector<vk::BufferCopy> copies;
    std::uint64_t first = 0;
    for (const BufferPiece &piece : pieces) {
        copies.push_back({.srcOffset = piece.offset, .dstOffset = first, .size = piece.data.size()});
        first += piece.data.size();
    }
    state_->staged(first, [&](const Allocation &staging, std::uint64_t, std::uint64_t) {
        state_->device.submit(
            [&](const vk::raii::CommandBuffer &commands) { commands.copyBuffer(handle(), *staging.buffer, copies); });
        for (std::size_t i = 0; i < pieces.size(); ++i)
            std::memcpy(pieces[i].data.data(), staging.mapped + copies[i].dstOffset, pieces[i].data.size());
    });
}

void Buffer::write(const vk::raii::CommandBuffer &commands, std::span<const std::byte> data) const {
    if (!data.empty())
        commands.updateBuffer<std::byte>(handle(), 0, data);
}

void Buffer::clear(const vk::raii::CommandBuffer &commands, std::uint64_t offset, std::uint64_t bytes) const {
    commands.fillBuffer(handle(), offset, bytes, 0);
}

std::span<std::byte> Buffer::host_memory() const {
    return {state_->allocation.mapped, state_->bytes};
}

} // namespace pt::vulkan
