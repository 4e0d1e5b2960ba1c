// Tests whether two images show the same light (shaders/README.md, section 11).
#pragma once

#include <pt/compare.h>

#include <string>
#include <vector>

namespace pt {

struct Comparison {
    pt_comparison verdict{};
    double rate = 0.0;                       // of this look
    std::vector<pt_compared_region> regions; // as pt_compare orders them
};

// info: valid, without defaults.
Comparison compare_light(const pt_compare_info &info);

// "different light: -3.1% +- 0.4% of the picture in G"
std::string summary_of(const Comparison &comparison, double min_change);

} // namespace pt
