#pragma once

#include "lib/vulkan/device.h"

#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <string>

namespace pt::vulkan {

enum class BufferUse {
    Storage,
    UniformOrStorage,
    Texels,
    Streamed,
    HostWritten, // in mapped memory
    HostRead     // in mapped memory
};

struct BufferPiece {
    std::span<std::byte> data;
    std::uint64_t offset;
};

inline constexpr std::uint64_t max_recorded_bytes = 65'536;

class Buffer {
public:
    Buffer(Device &device, BufferUse use, std::uint64_t bytes, const std::string &what);
    ~Buffer();
    Buffer(Buffer &&other) noexcept;
    Buffer &operator=(Buffer &&other) noexcept;

    std::uint64_t size() const;
    vk::Buffer handle() const;

    // Offsets and sizes must be multiples of 4 bytes. Without mapped memory, these functions wait for the device.
    void upload(std::span<const std::byte> data, std::uint64_t offset);
    void download(std::span<std::byte> data, std::uint64_t offset);
    void download(std::span<const BufferPiece> pieces);

    // data() is NULL if the host cannot access the buffer.
    std::span<std::byte> host_memory() const;

    void write(const vk::raii::CommandBuffer &commands, std::span<const std::byte> data) const;

    void clear(const vk::raii::CommandBuffer &commands, std::uint64_t offset, std::uint64_t bytes) const;

    void copy(const vk::raii::CommandBuffer &commands, const Buffer &other,
              const vk::ArrayProxy<const vk::BufferCopy> &pieces) const {
        commands.copyBuffer(other.handle(), handle(), pieces);
    }

private:
    struct State;
    std::unique_ptr<State> state_;
};

} // namespace pt::vulkan
