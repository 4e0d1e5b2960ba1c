#pragma once

#include "lib/kernel/device_film.h"
#include "lib/vulkan/buffer.h"
#include "lib/vulkan/compute_pipeline.h"
#include "lib/vulkan/device.h"
#include "lib/vulkan/submissions_under_way.h"
#include "shaders/gpu_layout.h"

#include <cstdint>
#include <list>
#include <span>
#include <vector>

namespace pt {

class FilmSum {
public:
    struct Source {
        vulkan::Device &device;
        DeviceFilm &film;
    };

    FilmSum(const std::vector<Source> &sources, const vulkan::ComputePipeline &add, std::uint32_t row_count);

    DeviceFilm &film() { return film_; }

    void gather(std::uint32_t first_row, const PixelRange &wanted);

private:
    struct Distant {
        Source source;
        std::vector<vulkan::Buffer> slots;
    };

    struct Added {
        PixelRange pixels;
        std::span<const vulkan::DescriptorSet> sets;
    };

    void add_own(const vk::raii::CommandBuffer &commands, std::uint32_t first_pixel, const PixelRange &wanted) const;
    void add_others(vulkan::SubmissionsUnderWay &at_home, std::uint32_t first_pixel, const PixelRange &wanted);
    void add(const vk::raii::CommandBuffer &commands, std::uint32_t first_pixel, const PixelRange &wanted,
             const Added &added) const;

    Source home_;
    const vulkan::ComputePipeline &add_;
    DeviceFilm film_;
    std::list<Distant> others_;
    std::uint32_t piece_pixels_;
    std::vector<vulkan::Buffer> slots_;
    std::vector<std::vector<vulkan::DescriptorSet>> slot_sets_;
    std::vector<std::vector<vulkan::DescriptorSet>> own_sets_;
};

vulkan::ComputePipeline add_pipeline(vulkan::Device &device, std::span<const std::uint32_t> code);

} // namespace pt
