#include "cli/course/verdict.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <utility>

namespace cli {

double misfit(std::span<const Measured> measured, const Pattern &pattern) {
    double worst = 0.0;
    for (std::size_t i = 0; i < measured.size(); ++i) {
        const auto [name, value, bound] = measured[i];
        const Range range = pattern.values.at(i);
        const double outside = std::max({range.least - value, value - range.most, 0.0});
        if (!std::isfinite(value) && !std::isinf(range.least))
            return std::numeric_limits<double>::infinity();
        if (outside > 0.0)
            worst = std::max(worst, outside / std::max(bound, std::numeric_limits<double>::min()));
    }
    return worst;
}

CourseVerdict judge(std::vector<Measured> measured, std::span<const Pattern> patterns) {
    const auto better = [&](const Pattern *best, const Pattern &pattern) {
        return best == nullptr || misfit(measured, pattern) < misfit(measured, *best) ? &pattern : best;
    };
    const Pattern *right = nullptr;
    for (const Pattern &pattern : patterns)
        if (pattern.is_right())
            right = better(right, pattern);
    const auto differs = [](const Range &range, const Range &from) {
        return !std::isinf(range.least) && (range.least != from.least || range.most != from.most);
    };
    const Pattern *best = right;
    for (const Pattern &pattern : patterns)
        if (!std::ranges::equal(std::span(pattern.values).first(measured.size()),
                                std::span(right->values).first(measured.size()), std::not_fn(differs)))
            best = better(best, pattern);
    if (misfit(measured, *right) <= 1.0)
        best = right;
    if (misfit(measured, *best) > 1.0)
        best = nullptr;
    return {std::move(measured), right->values, best ? std::optional(*best) : std::nullopt, "", 0.0};
}

} // namespace cli
