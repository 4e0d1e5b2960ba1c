#pragma once

#include "lib/vulkan/buffer.h"
#include "lib/vulkan/compute_pipeline.h"
#include "lib/vulkan/device.h"

#include "recurrence.spv.h"

#include <array>
#include <cstddef>
#include <cstdint>
#include <numeric>
#include <span>
#include <vector>

class Recurrence {
public:
    static constexpr std::uint32_t multiplier = 1664525;
    static constexpr std::uint32_t increment = 1013904223;
    static constexpr std::uint32_t offset = 41;

    Recurrence(pt::vulkan::Device &device, std::uint32_t group_count) :
        device_(device),
        group_count_(group_count),
        pipeline_(device, recurrence_spirv(),
                  std::array<pt::vulkan::Binding, 2>{{{0, vk::DescriptorType::eUniformBuffer}, {1}}}, 4,
                  std::array{multiplier, increment}),
        offset_(device, pt::vulkan::BufferUse::UniformOrStorage, 1U << 17, "offset"),
        values_(device, pt::vulkan::BufferUse::Storage, value_count() * 4, "values"),
        set_(pipeline_.bind(std::array<pt::vulkan::BufferRange, 2>{offset_, values_})) {}

    std::size_t value_count() const { return std::size_t{group_count_} * 64; }
    pt::vulkan::Buffer &values() { return values_; }

    void start_with(std::span<const std::uint32_t> values) {
        const std::array words = {offset, 0U, 0U, 0U};
        offset_.upload(std::as_bytes(std::span(words)), 0);
        values_.upload(std::as_bytes(values), 0);
    }

    static std::uint32_t expected(std::uint32_t value, std::uint32_t steps) {
        value += offset;
        for (std::uint32_t i = 0; i < steps; ++i)
            value = value * multiplier + increment;
        return value;
    }

    void record(const vk::raii::CommandBuffer &commands, std::uint32_t steps) const {
        pipeline_.dispatch(commands, set_, std::as_bytes(std::span(&steps, 1)), group_count_);
    }

    double run(std::uint32_t steps) {
        return device_.submit([&](const vk::raii::CommandBuffer &commands) { record(commands, steps); });
    }

private:
    pt::vulkan::Device &device_;
    std::uint32_t group_count_;
    pt::vulkan::ComputePipeline pipeline_;
    pt::vulkan::Buffer offset_;
    pt::vulkan::Buffer values_;
    pt::vulkan::DescriptorSet set_;
};

inline void clear_all(pt::vulkan::Device &device, const pt::vulkan::Buffer &buffer) {
    device.submit([&](const vk::raii::CommandBuffer &commands) { buffer.clear(commands, 0, buffer.size()); });
}

inline std::vector<std::uint32_t> counting(std::size_t count) {
    std::vector<std::uint32_t> values(count);
    std::iota(values.begin(), values.end(), 1000U);
    return values;
}

inline std::vector<std::uint32_t> zeros(std::size_t count) {
    return std::vector<std::uint32_t>(count, 0U);
}

inline void upload(pt::vulkan::Buffer &buffer, std::span<const std::uint32_t> values, std::size_t first = 0) {
    buffer.upload(std::as_bytes(values), first * 4);
}

inline std::vector<std::uint32_t> download(pt::vulkan::Buffer &buffer, std::size_t first, std::size_t count) {
    std::vector<std::uint32_t> values(count);
    buffer.download(std::as_writable_bytes(std::span(values)), first * 4);
    return values;
}
