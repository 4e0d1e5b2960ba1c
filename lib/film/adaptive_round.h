// How far a film has come on its way to a target error, by the rule of adaptive_rule.h. A value that belongs to the
// film.
#pragma once

#include <algorithm>
#include <cstdint>
#include <limits>

namespace pt {

struct AdaptiveRound {
    static constexpr std::int32_t none = std::numeric_limits<std::int32_t>::min();

    std::int32_t number = none; // the bound is 2^(-number / 2), of squared relative error a sample and pixel
    std::uint64_t floor = 0;    // samples that every pixel is to have

    bool operator==(const AdaptiveRound &) const = default;
};

// The round of two films that are added.
inline AdaptiveRound later_of(const AdaptiveRound &a, const AdaptiveRound &b) {
    return {std::max(a.number, b.number), std::max(a.floor, b.floor)};
}

} // namespace pt
