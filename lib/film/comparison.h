#pragma once

#include <pt/compare.h>

#include <cstdint>
#include <string>
#include <vector>

namespace pt {

struct Comparison {
    pt_comparison verdict{};
    std::vector<pt_compared_region> regions; // same order as for pt_compare
};

// `info` must be valid, with its defaults filled in.
Comparison compare_light(const pt_compare_info &info);

std::uint32_t region_count_of(const pt_compare_info &info);

std::string summary_of(const Comparison &comparison, double min_change);

} // namespace pt
