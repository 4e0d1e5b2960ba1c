// Allocation and transfers; see buffer.h.
#include "vulkan/buffer.h"

#include "vulkan/result.h"

#include <algorithm>
#include <array>
#include <cstring>
#include <optional>
#include <utility>

namespace pt::vulkan {

namespace {

using Property = vk::MemoryPropertyFlagBits;
constexpr vk::MemoryPropertyFlags host_readable =
    Property::eHostVisible | Property::eHostCoherent | Property::eHostCached;

// Large transfers go through a staging buffer of this size at most.
constexpr std::uint64_t max_staging_bytes = 64U << 20;

vk::raii::Buffer create_buffer(const Device &device, vk::BufferUsageFlags usage, std::uint64_t bytes) {
    return device.handle().createBuffer({.size = bytes, .usage = usage, .sharingMode = vk::SharingMode::eExclusive});
}

// Index of the first memory type that the buffer may use and that has the first of the wanted properties to be found.
std::uint32_t memory_type(const Device &device, std::uint32_t allowed,
                          std::span<const vk::MemoryPropertyFlags> wanted_best_first) {
    const vk::PhysicalDeviceMemoryProperties &memory = device.memory_properties();
    for (const vk::MemoryPropertyFlags wanted : wanted_best_first)
        for (std::uint32_t i = 0; i < memory.memoryTypeCount; ++i)
            if ((allowed >> i & 1) != 0 && (memory.memoryTypes[i].propertyFlags & wanted) == wanted)
                return i;
    throw Error(PT_ERROR_UNSUPPORTED, "the device has no memory of the kind that a buffer needs");
}

struct Allocation {
    vk::raii::DeviceMemory memory;
    vk::MemoryPropertyFlags properties;
    std::uint64_t bytes;
};

Allocation allocate(const Device &device, const vk::raii::Buffer &buffer,
                    std::span<const vk::MemoryPropertyFlags> wanted_best_first) {
    const vk::MemoryRequirements needs = buffer.getMemoryRequirements();
    const std::uint32_t type = memory_type(device, needs.memoryTypeBits, wanted_best_first);
    return {device.handle().allocateMemory({.allocationSize = needs.size, .memoryTypeIndex = type}),
            device.memory_properties().memoryTypes[type].propertyFlags, needs.size};
}

// Host memory that the device can copy from and to.
class Staging {
public:
    Staging(const Device &device, std::uint64_t bytes) :
        buffer_(create_buffer(device, vk::BufferUsageFlagBits::eTransferSrc | vk::BufferUsageFlagBits::eTransferDst,
                              bytes)) {
        constexpr std::array<vk::MemoryPropertyFlags, 2> wanted = {
            host_readable, Property::eHostVisible | Property::eHostCoherent};
        memory_ = std::move(allocate(device, buffer_, wanted).memory);
        buffer_.bindMemory(*memory_, 0);
        mapped_ = static_cast<std::byte *>(memory_.mapMemory(0, VK_WHOLE_SIZE));
    }

    vk::Buffer handle() const { return *buffer_; }
    std::byte *data() const { return mapped_; }

private:
    vk::raii::DeviceMemory memory_ = nullptr;
    vk::raii::Buffer buffer_;
    std::byte *mapped_;
};

} // namespace

Buffer::Buffer(Device &device, BufferUse use, std::uint64_t bytes, const std::string &what) :
    device_(&device), bytes_(bytes) {
    device.require_alive();
    const std::string doing = "allocating " + std::to_string(bytes) + " bytes for the " + what;
    if (bytes > device.limits().max_allocation_bytes)
        throw Error(PT_ERROR_OUT_OF_DEVICE_MEMORY, doing + ": the device allows " +
                                                       std::to_string(device.limits().max_allocation_bytes) +
                                                       " in one allocation");
    using Usage = vk::BufferUsageFlagBits;
    vk::BufferUsageFlags usage = Usage::eStorageBuffer | Usage::eTransferSrc | Usage::eTransferDst;
    if (use == BufferUse::Scene)
        usage |= Usage::eUniformBuffer;
    translated(doing, [&] {
        // Memory that host and device share, where the device has it and is as fast in it: software Vulkan.
        constexpr std::array<vk::MemoryPropertyFlags, 3> wanted = {
            Property::eDeviceLocal | host_readable, Property::eDeviceLocal, vk::MemoryPropertyFlags{}};
        const bool shared = device.info().kind == PT_DEVICE_CPU || device.info().kind == PT_DEVICE_INTEGRATED_GPU;
        buffer_ = create_buffer(device, usage, bytes);
        Allocation allocation = allocate(device, buffer_, std::span(wanted).subspan(shared ? 0 : 1));
        memory_ = std::move(allocation.memory);
        buffer_.bindMemory(*memory_, 0);
        if (shared && (allocation.properties & host_readable) == host_readable)
            mapped_ = static_cast<std::byte *>(memory_.mapMemory(0, VK_WHOLE_SIZE));
    });
    device.count_allocation(bytes);
}

Buffer::~Buffer() {
    if (*buffer_)
        device_->count_release(bytes_);
}

Buffer::Buffer(Buffer &&other) noexcept :
    device_(other.device_), bytes_(other.bytes_), memory_(std::exchange(other.memory_, nullptr)),
    buffer_(std::exchange(other.buffer_, nullptr)), mapped_(std::exchange(other.mapped_, nullptr)) {}

Buffer &Buffer::operator=(Buffer &&other) noexcept {
    Buffer moved(std::move(other));
    swap(moved);
    return *this;
}

void Buffer::swap(Buffer &other) noexcept {
    std::swap(device_, other.device_);
    std::swap(bytes_, other.bytes_);
    memory_.swap(other.memory_);
    buffer_.swap(other.buffer_);
    std::swap(mapped_, other.mapped_);
}

void Buffer::upload(std::span<const std::byte> data, std::uint64_t offset) {
    device_->require_alive();
    if (data.empty())
        return;
    if (mapped_) {
        std::memcpy(mapped_ + offset, data.data(), data.size());
        return;
    }
    translated("uploading", [&] {
        const Staging staging(*device_, std::min<std::uint64_t>(data.size(), max_staging_bytes));
        for (std::uint64_t done = 0; done < data.size();) {
            const std::uint64_t piece = std::min<std::uint64_t>(data.size() - done, max_staging_bytes);
            std::memcpy(staging.data(), data.data() + done, piece);
            const vk::BufferCopy copy{.srcOffset = 0, .dstOffset = offset + done, .size = piece};
            device_->submit([&](const vk::raii::CommandBuffer &commands) {
                commands.copyBuffer(staging.handle(), *buffer_, copy);
            });
            done += piece;
        }
    });
}

void Buffer::download(std::span<std::byte> data, std::uint64_t offset) {
    device_->require_alive();
    if (data.empty())
        return;
    if (mapped_) {
        std::memcpy(data.data(), mapped_ + offset, data.size());
        return;
    }
    translated("downloading", [&] {
        const Staging staging(*device_, std::min<std::uint64_t>(data.size(), max_staging_bytes));
        for (std::uint64_t done = 0; done < data.size();) {
            const std::uint64_t piece = std::min<std::uint64_t>(data.size() - done, max_staging_bytes);
            const vk::BufferCopy copy{.srcOffset = offset + done, .dstOffset = 0, .size = piece};
            device_->submit([&](const vk::raii::CommandBuffer &commands) {
                commands.copyBuffer(*buffer_, staging.handle(), copy);
            });
            std::memcpy(data.data() + done, staging.data(), piece);
            done += piece;
        }
    });
}

void Buffer::clear() {
    device_->submit([&](const vk::raii::CommandBuffer &commands) {
        commands.fillBuffer(*buffer_, 0, VK_WHOLE_SIZE, 0);
    });
}

} // namespace pt::vulkan
