#pragma once

#include <pt/pt.h>

#include <cstdint>

namespace pt {

struct RenderSettings {
    std::uint32_t width; // width * height < 2^32
    std::uint32_t height;
    std::uint32_t max_path_length;
    std::uint64_t seed;
    std::uint32_t first_sample;
    std::uint32_t estimator;
    std::uint32_t sampler;
    std::uint32_t first_row;
    std::uint32_t row_count;
    bool coverage = false; // counts the samples that hit a surface
};

// Throws PT_ERROR_INVALID_ARGUMENT with all broken rules.
RenderSettings validated_render(const pt_render &source);

} // namespace pt
