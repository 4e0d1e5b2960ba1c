#include "lib/scene/render_settings.h"

#include "lib/base/rules.h"
#include "shaders/gpu_layout.h"

#include <algorithm>

namespace pt {

namespace {

// Pixel indices have 32 bits.
constexpr std::uint64_t max_pixel_count = UINT32_MAX;

constexpr std::uint32_t all_flags = PT_RENDER_COVERAGE;

} // namespace

RenderSettings validated_render(const pt_render &source) {
    Violations violations;
    const Subject render(violations, "render");
    const std::uint64_t pixel_count = std::uint64_t{source.width} * source.height;
    render.require(source.width >= 1, "width", source.width, "must be >= 1");
    render.require(source.height >= 1, "height", source.height, "must be >= 1");
    render.require(pixel_count <= max_pixel_count, {"width", "* height"}, pixel_count, "must be <= 4294967295");
    render.require(source.max_path_length <= 1024, "max_path_length", source.max_path_length, "must be <= 1024");
    render.require(source.estimator <= gpu::LAST_ESTIMATOR, "estimator", source.estimator,
                   "must be a PT_ESTIMATOR_* of pt.h");
    render.require(source.sampler <= gpu::LAST_SAMPLER, "sampler", source.sampler, "must be a PT_SAMPLER_* of pt.h");
    render.require((source.flags & ~all_flags) == 0, "flags", source.flags, "must have only bits PT_RENDER_* of pt.h");
    render.require(source.first_row < std::max(source.height, 1U), "first_row", source.first_row, "must be < height");
    const std::uint64_t rows_end = std::uint64_t{source.first_row} + source.row_count;
    render.require(rows_end <= source.height, {"first_row", "+ row_count"}, rows_end, "must be <= height");
    violations.throw_if_any(PT_ERROR_INVALID_ARGUMENT);
    return {source.width,
            source.height,
            source.max_path_length == 0 ? PT_DEFAULT_MAX_PATH_LENGTH : source.max_path_length,
            source.seed,
            source.first_sample,
            source.estimator == PT_ESTIMATOR_BEST ? std::uint32_t{PT_ESTIMATOR_MIS} : source.estimator,
            source.sampler == PT_SAMPLER_BEST ? std::uint32_t{PT_SAMPLER_SOBOL} : source.sampler,
            source.first_row,
            source.row_count == 0 ? source.height - source.first_row : source.row_count,
            (source.flags & PT_RENDER_COVERAGE) != 0};
}

} // namespace pt
