#include "lib/film/comparison.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdio>
#include <string>

namespace pt {

namespace {

std::string percent(double share) {
    std::array<char, 32> text{};
    std::snprintf(text.data(), text.size(), "%.2g%%", 100.0 * share);
    return text.data();
}

std::size_t clearest_channel(const pt_compared_region &region) {
    const auto clarity = [&](std::size_t channel) {
        return std::abs(region.difference[channel]) / std::max(region.deviation[channel], 1e-300);
    };
    std::size_t clearest = 0;
    for (std::size_t channel = 1; channel < 3; ++channel)
        if (clarity(channel) > clarity(clearest))
            clearest = channel;
    return clearest;
}

std::string change_of(const pt_compared_region &region, bool is_whole) {
    const std::size_t channel = clearest_channel(region);
    const double light = region.light[channel];
    const std::string sign = region.difference[channel] < 0.0 ? "-" : "+";
    const std::string place = std::to_string(region.width) + "x" + std::to_string(region.height) + " pixels at " +
                              std::to_string(region.x) + "," + std::to_string(region.y);
    return sign + percent(std::abs(region.difference[channel] / light)) + " +- " +
           percent(1.96 * region.deviation[channel] / std::abs(light)) + " of " + (is_whole ? "the picture" : place) +
           " in " + "RGB"[channel];
}

std::string clearest_change_of(const Comparison &comparison) {
    const auto &regions = comparison.regions;
    const auto clearest = std::ranges::min_element(regions, {}, &pt_compared_region::probability);
    const bool is_whole = regions.front().probability <= comparison.verdict.rate;
    return change_of(is_whole ? regions.front() : *clearest, is_whole);
}

} // namespace

std::string summary_of(const Comparison &comparison, double min_change) {
    const pt_comparison &verdict = comparison.verdict;
    if (verdict.light == PT_LIGHT_EQUAL_BITS)
        return "equal bits";
    if (verdict.light == PT_LIGHT_DIFFERENT)
        return "different light: " + clearest_change_of(comparison);
    if (!std::isfinite(verdict.smallest_change))
        return "too few samples to tell: any change may be missed";
    std::string found = "a change by " + percent(verdict.smallest_change) + " of all light";
    if (std::isfinite(verdict.smallest_tile_change))
        found += ", or " + percent(verdict.smallest_tile_change) + " of that of 32x32 pixels,";
    found += " would have been found";
    return verdict.light == PT_LIGHT_SAME ? "same light: " + found
                                          : "too few samples to tell: " + found + ", not " + percent(min_change);
}

} // namespace pt
