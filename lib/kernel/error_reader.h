// Reads what a film says about the error of its image: estimate.comp sums it up by regions, on the device. Owned by
// RenderDevice; bound to its film.
#pragma once

#include "lib/film/device_film.h"
#include "lib/film/error_estimate.h"
#include "lib/vulkan/buffer.h"
#include "lib/vulkan/compute_pipeline.h"
#include "lib/vulkan/device.h"

#include <cstdint>
#include <functional>
#include <optional>
#include <span>
#include <vector>

namespace pt {

class ErrorReader {
public:
    // All must outlive it. estimate: of estimate_pipeline(). The film's strips must be whole rows of regions.
    ErrorReader(vulkan::Device &device, const vulkan::ComputePipeline &estimate, DeviceFilm &film);

    // Calls receive(region) for every region of the film, always in the same order. unit: of the film, a power of two, in
    // radiance; samples: that every pixel has. Throws PT_ERROR_INTERNAL if a driver lost work.
    void read(double unit, const PartCounts &samples, const std::function<void(const RegionErrors &)> &receive);

private:
    vulkan::Device &device_;
    const vulkan::ComputePipeline &estimate_;
    DeviceFilm &film_;
    vulkan::Buffer regions_; // of a strip
    vulkan::Buffer host_;
    std::vector<vulkan::DescriptorSet> sets_; // one per strip
};

vulkan::ComputePipeline estimate_pipeline(vulkan::Device &device, std::span<const std::uint32_t> code);

} // namespace pt
