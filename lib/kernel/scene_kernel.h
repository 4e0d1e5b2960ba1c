#pragma once

#include "lib/view/view.h"
#include "lib/vulkan/compute_pipeline.h"
#include "lib/vulkan/device.h"

#include <cstddef>
#include <cstdint>
#include <initializer_list>
#include <optional>
#include <span>
#include <vector>

namespace pt {

std::vector<vulkan::Binding> with_scene_bindings(std::initializer_list<vulkan::Binding> further);
std::vector<vulkan::BufferRange> scene_ranges(const View &view, const vulkan::Buffer &words,
                                              const vulkan::Buffer *tree);

struct BoundScene {
    const View &view;
    std::vector<vulkan::BufferRange> ranges;
};

class SceneKernel {
public:
    SceneKernel(vulkan::Device &device, std::span<const std::uint32_t> code, std::vector<vulkan::Binding> bindings,
                std::uint32_t push_constant_bytes);

    void fit(std::span<const std::uint32_t> constants);

    vulkan::DescriptorSet bind(const BoundScene &bound, std::initializer_list<vulkan::BufferRange> ranges) const;
    void dispatch(const vk::raii::CommandBuffer &commands, const vulkan::DescriptorSet &set,
                  std::span<const std::byte> push_constants, std::uint64_t invocations) const;

    std::uint64_t pixels_at_once(std::uint64_t pixels, std::uint32_t rays_of_pixel, double rays) const;

private:
    vulkan::Device &device_;
    std::span<const std::uint32_t> code_;
    std::vector<vulkan::Binding> bindings_;
    std::uint32_t push_constant_bytes_;
    std::vector<std::uint32_t> constants_;
    std::optional<vulkan::ComputePipeline> pipeline_;
};

// Returns the number of rays that take about this many tests together, at least 1.
double rays_for(double tests, const View &view);

void require_all_met(std::uint32_t lost_pixels);

} // namespace pt
