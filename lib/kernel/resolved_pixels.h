// A kernel's results for pixels. The first bytes have the number of lost pixels.
#pragma once

#include "lib/vulkan/buffer.h"
#include "lib/vulkan/compute_pipeline.h"
#include "lib/vulkan/device.h"

#include <cstddef>
#include <cstdint>
#include <cstring>
#include <span>
#include <string>

namespace pt {

class ResolvedPixels {
public:
    // A multiple of the alignment of all devices.
    static constexpr std::uint64_t findings_bytes = 256;

    ResolvedPixels(vulkan::Device &device, std::uint64_t bytes, const std::string &what) :
        found_(device, vulkan::BufferUse::Storage, findings_bytes + bytes, what),
        host_(device, vulkan::BufferUse::HostRead, findings_bytes + bytes, what) {}

    const vulkan::Buffer &found() const { return found_; }
    std::uint64_t room() const { return found_.size() - findings_bytes; }

    vulkan::BufferRange pixels() const { return {found_.handle(), findings_bytes, room()}; }
    vulkan::BufferRange findings() const { return {found_.handle(), 0, findings_bytes}; }

    // clear() must be recorded before the kernel, hand_over() after it.
    void clear(const vk::raii::CommandBuffer &commands) const { found_.clear(commands, 0, findings_bytes); }
    void hand_over(const vk::raii::CommandBuffer &commands, std::uint64_t bytes) const {
        host_.copy(commands, found_, vk::BufferCopy{.size = findings_bytes + bytes});
    }

    std::span<const std::byte> bytes() const { return host_.host_memory().subspan(findings_bytes); }
    std::uint32_t lost_pixels() const {
        std::uint32_t count = 0;
        std::memcpy(&count, host_.host_memory().data(), sizeof count);
        return count;
    }

private:
    vulkan::Buffer found_;
    vulkan::Buffer host_;
};

} // namespace pt
