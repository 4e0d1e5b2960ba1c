#include "cli/course/verdict.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace cli {

double misfit(std::span<const Measured> measured, const Pattern &pattern) {
    double worst = 0.0;
    for (std::size_t i = 0; i < measured.size(); ++i) {
        const auto [name, value, bound] = measured[i];
        const Range range = pattern.values.at(i);
        const double outside = std::max({range.least - value, value - range.most, 0.0});
        if (!std::isfinite(value) && !(range.least < 0.0 && std::isinf(range.least)))
            return std::numeric_limits<double>::infinity();
        if (outside > 0.0)
            worst = std::max(worst, outside / std::max(bound, std::numeric_limits<double>::min()));
    }
    return worst;
}

CourseVerdict judge(std::vector<Measured> measured, std::span<const Pattern> patterns) {
    const Pattern *best = nullptr;
    const Pattern *right = nullptr;
    for (const Pattern &pattern : patterns) {
        const auto is_better = [&](const Pattern *than) {
            return than == nullptr || misfit(measured, pattern) < misfit(measured, *than);
        };
        if (pattern.is_right() && is_better(right))
            right = &pattern;
        if (is_better(best))
            best = &pattern;
    }
    if (misfit(measured, *right) <= 1.0)
        best = right;
    if (misfit(measured, *best) > 1.0)
        best = nullptr;
    return {std::move(measured), right->values, best ? std::optional(*best) : std::nullopt, ""};
}

} // namespace cli
