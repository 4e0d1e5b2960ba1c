#include <pt/denoise.h>

#include "lib/api/context.h"
#include "lib/api/guard.h"
#include "lib/base/check_values.h"
#include "lib/base/struct_size.h"
#include "lib/denoise/combination.h"
#include "lib/denoise/open_image_denoise.h"
#include "lib/film/stopping.h"

#include <algorithm>
#include <cmath>
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

ErrorEstimate denoise(const pt_denoise_info *info, pt_error_estimate *error) {
    struct_size_of(error, "error");
    const ErrorEstimate estimate = denoise(validated_denoise(info));
    copy_out(stated(estimate), error, "error");
    return estimate;
}

pt_rounds_info validated_rounds(const pt_rounds_info *user) {
    const pt_rounds_info rounds = copy_in(user, "rounds");
    Violations violations;
    const Subject subject(violations, "rounds");
    subject.require(rounds.sample_count >= 1, "sample_count", rounds.sample_count, "must be >= 1");
    Stopping{rounds.stopping}.check(violations);
    if (!rounds.render)
        subject.refuse("render", "NULL", "must not be NULL");
    violations.throw_if_any(PT_ERROR_INVALID_ARGUMENT);
    return rounds;
}

pt_result denoise_rounds(const pt_rounds_info &rounds, const pt_denoise_info *info, pt_error_estimate *error) {
    constexpr double first = 16.0; // the first number with a known error
    const Stopping stopping{rounds.stopping};
    double done = 0.0;
    double end = stopping.has_any() ? std::min<double>(first, rounds.sample_count) : rounds.sample_count;
    while (end > done) {
        if (rounds.render(rounds.render_user, static_cast<std::uint32_t>(end)) != 0)
            return PT_CANCELLED;
        if (stopping.is_reached(denoise(info, error)))
            return PT_TARGET_REACHED;
        done = end;
        end = std::min<double>(std::max(std::floor(1.5 * done), first), rounds.sample_count);
        if (const double spent = stopping.spent(); spent > 0.0)
            end = std::min(end, std::floor(done / spent));
    }
    return done < rounds.sample_count ? PT_LIMIT_REACHED : PT_OK;
}

} // namespace

} // namespace pt

pt_result pt_denoise(const pt_denoise_info *info, pt_error_estimate *error) {
    return pt::guard(pt::thread_last_error, [&] { pt::denoise(info, error); });
}

pt_result pt_denoise_rounds(const pt_rounds_info *rounds, const pt_denoise_info *info, pt_error_estimate *error) {
    return pt::guard(pt::thread_last_error,
                     [&] { return pt::denoise_rounds(pt::validated_rounds(rounds), info, error); });
}
