// A buffer on the device with memory of its own. Made by Film and Renderer.
#pragma once

#include "vulkan/device.h"

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>

namespace pt::vulkan {

enum class BufferUse {
    Storage, // kernels read and write it
    Scene    // kernels read it, as uniform or as storage
};

class Buffer {
public:
    // what names it in error messages. Throws PT_ERROR_OUT_OF_DEVICE_MEMORY. The device must outlive the buffer.
    Buffer(Device &device, BufferUse use, std::uint64_t bytes, const std::string &what);
    ~Buffer();
    Buffer(Buffer &&other) noexcept;
    Buffer &operator=(Buffer &&other) noexcept;

    std::uint64_t size() const { return bytes_; }
    vk::Buffer handle() const { return *buffer_; }

    // All wait for the device; offsets and sizes are multiples of 4 bytes.
    void upload(std::span<const std::byte> data, std::uint64_t offset);
    void download(std::span<std::byte> data, std::uint64_t offset);
    void clear();

private:
    void swap(Buffer &other) noexcept;

    Device *device_;
    std::uint64_t bytes_;
    vk::raii::DeviceMemory memory_ = nullptr;
    vk::raii::Buffer buffer_ = nullptr; // destroyed before its memory is freed
    std::byte *mapped_ = nullptr;       // where the memory can be read fast by the host, else null
};

} // namespace pt::vulkan
