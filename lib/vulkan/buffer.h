// A buffer on the device with memory of its own. Made by Film and Kernel, and to measure accuracy.
#pragma once

#include "lib/vulkan/device.h"

#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <string>

namespace pt::vulkan {

enum class BufferUse {
    Storage,          // kernels read and write it
    UniformOrStorage, // kernels read it as either, or as texels
    Texels,           // kernels read it as texels
    Streamed,         // kernels read it as uniform; the host writes it often, and never waits to do so
    HostWritten,      // kernels read it; the host writes it in place, and never waits to do so
    HostRead          // copied to or written by kernels, and read by the host in place once that has ended
};

// A part of a buffer and where its bytes go.
struct BufferPiece {
    std::span<std::byte> data;
    std::uint64_t offset;
};

// The most that Vulkan lets a command carry.
inline constexpr std::uint64_t max_recorded_bytes = 65'536;

class Buffer {
public:
    // what names it in error messages. Throws PT_ERROR_OUT_OF_DEVICE_MEMORY. The device must outlive the buffer.
    Buffer(Device &device, BufferUse use, std::uint64_t bytes, const std::string &what);
    ~Buffer();
    Buffer(Buffer &&other) noexcept;
    Buffer &operator=(Buffer &&other) noexcept;

    std::uint64_t size() const;
    vk::Buffer handle() const;

    // All but uploads to a streamed buffer wait for the device. Offsets and sizes are multiples of 4 bytes and lie
    // within the buffer.
    void upload(std::span<const std::byte> data, std::uint64_t offset);
    void download(std::span<std::byte> data, std::uint64_t offset);
    void download(std::span<const BufferPiece> pieces);

    // What is in a buffer for the host to read, or to write.
    std::span<const std::byte> host_bytes() const;
    std::span<std::byte> host_memory();

    // Records that the first bytes of it become these: no more than max_recorded_bytes.
    void write(const vk::raii::CommandBuffer &commands, std::span<const std::byte> data) const;

    // Records that bytes become 0. Offset and size as above.
    void clear(const vk::raii::CommandBuffer &commands, std::uint64_t offset, std::uint64_t bytes) const;

    // Records that bytes from an offset on become the first of another buffer.
    void copy(const vk::raii::CommandBuffer &commands, const Buffer &other, std::uint64_t bytes,
              std::uint64_t offset = 0) const;
    void copy(const vk::raii::CommandBuffer &commands, const Buffer &other,
              std::span<const vk::BufferCopy> pieces) const;

private:
    struct State;
    std::unique_ptr<State> state_;
};

} // namespace pt::vulkan
