#include <pt/denoise.h>

#include "lib/api/context.h"
#include "lib/api/guard.h"
#include "lib/base/check_values.h"
#include "lib/base/struct_size.h"
#include "lib/denoise/combination.h"
#include "lib/denoise/open_image_denoise.h"

#include <algorithm>
#include <cstdint>
#include <vector>

namespace pt {

namespace {

pt_denoise_info validated_denoise(const pt_denoise_info *user) {
    const pt_denoise_info info = copy_in(user, "denoise");
    Violations violations;
    const Subject subject(violations, "denoise");
    const std::uint64_t pixel_count = std::uint64_t{info.width} * info.height;
    subject.require(pixel_count >= 1 && pixel_count <= UINT32_MAX, {"width", "* height"}, pixel_count,
                    "must be in [1, 2^32 - 1]");
    violations.throw_if_any(PT_ERROR_INVALID_ARGUMENT);
    check_values(subject, "first", info.first, 3 * pixel_count, &finite_rule);
    check_values(subject, "second", info.second, 3 * pixel_count, &finite_rule);
    check_values(subject, "albedo", info.albedo, 3 * pixel_count, &finite_rule);
    check_values(subject, "normal", info.normal, 3 * pixel_count, &finite_rule);
    if (!info.denoised)
        subject.refuse("denoised", "NULL", "must not be NULL");
    violations.throw_if_any(PT_ERROR_INVALID_ARGUMENT);
    return info;
}

ErrorEstimate denoise(const pt_denoise_info &info) {
    const std::size_t value_count = std::size_t{3} * info.width * info.height;
    std::vector<float> first(value_count);
    std::vector<float> second(value_count);
    run_open_image_denoise(info, first.data(), second.data());
    return combine(info, first.data(), second.data());
}

} // namespace

} // namespace pt

pt_result pt_denoise(const pt_denoise_info *info, pt_error_estimate *error) {
    return pt::guard(pt::thread_last_error, [&] {
        pt::struct_size_of(error, "error");
        pt::copy_out(pt::stated(pt::denoise(pt::validated_denoise(info))), error, "error");
    });
}

uint32_t pt_next_round(uint32_t sample_count) {
    constexpr std::uint64_t first = 16; // the first number with a known error
    const std::uint64_t next = std::uint64_t{sample_count} + sample_count / 2;
    return static_cast<std::uint32_t>(std::clamp<std::uint64_t>(next, first, UINT32_MAX));
}
