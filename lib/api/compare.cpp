#include <pt/compare.h>

#include "lib/api/context.h"
#include "lib/api/guard.h"
#include "lib/base/check_values.h"
#include "lib/base/struct_size.h"
#include "lib/film/comparison.h"

#include <algorithm>
#include <string>

namespace pt {

namespace {

void check_image(const Subject &subject, const pt_compared_image &image, std::uint64_t pixel_count) {
    subject.require(image.sampler != PT_SAMPLER_HALTON, "sampler", image.sampler,
                    "must not be PT_SAMPLER_HALTON, whose errors are not random");
    subject.require(image.min_samples == image.max_samples, "max_samples", image.max_samples,
                    "must be min_samples, " + std::to_string(image.min_samples) +
                        ": adaptive sampling shifts the mean");
    check_values(subject, "radiance", image.radiance, 3 * pixel_count, &finite_rule);
}

pt_compare_info validated_compare(const pt_compare_info *user) {
    pt_compare_info info = copy_in(user, "compare");
    Violations violations;
    const Subject subject(violations, "compare");
    const std::uint64_t pixel_count = std::uint64_t{info.width} * info.height;
    subject.require(pixel_count >= 1 && pixel_count <= UINT32_MAX, {"width", "* height"}, pixel_count,
                    "must be in [1, 2^32 - 1]");
    subject.require(info.rate >= 0.0 && info.rate <= 0.5, "rate", info.rate, "must be in (0, 0.5], or 0");
    subject.check("min_change", info.min_change, not_negative_rule);
    violations.throw_if_any(PT_ERROR_INVALID_ARGUMENT);
    check_image(Subject(violations, "first"), info.first, pixel_count);
    check_image(Subject(violations, "second"), info.second, pixel_count);
    violations.throw_if_any(PT_ERROR_INVALID_ARGUMENT);
    info.rate = info.rate > 0.0 ? info.rate : 1e-6;
    info.min_change = info.min_change > 0.0 ? info.min_change : 1.0;
    return info;
}

} // namespace

} // namespace pt

pt_result pt_compare(const pt_compare_info *info, pt_comparison *comparison, pt_compared_region *regions,
                     uint32_t *count) {
    return pt::guard(pt::thread_last_error, [&] {
        pt::require_not_null(count, "count");
        if (comparison || regions)
            pt::struct_size_of(comparison, "comparison");
        const pt_compare_info valid = pt::validated_compare(info);
        if (!comparison && !regions) {
            *count = pt::region_count_of(valid);
            return;
        }
        pt::Comparison result = pt::compare_light(valid);
        const auto available = static_cast<std::uint32_t>(result.regions.size());
        *count = regions ? std::min(*count, available) : available;
        if (regions)
            std::copy_n(result.regions.begin(), *count, regions);
        pt::copy_out(result.verdict, comparison, "comparison");
    });
}
