// Whether two pictures show the same light, by pt_compare.
#pragma once

#include "cli/image/image_module.h"

#include <pt/compare.h>

#include <nlohmann/json.hpp>

#include <optional>
#include <span>
#include <string>
#include <vector>

namespace cli {

// A picture for the test.
struct TestedImage {
    ImageWindow window;
    std::span<const float> radiance; // three values a pixel
    std::uint32_t min_samples;       // of a pixel
    std::uint32_t max_samples;
    std::uint32_t sampler = 0;   // 0: unknown
    bool may_miss_light = false; // as in pt_compared_image
};

struct LightRule {
    std::optional<double> rate;
    std::optional<double> min_change;
};

struct LightVerdict {
    pt_comparison comparison;
    std::vector<pt_compared_region> regions;
    ImageWindow window;
    double rate;

    bool is_different() const { return comparison.light == PT_LIGHT_DIFFERENT; }
    bool is_decided() const { return comparison.light != PT_LIGHT_UNDECIDED; }
};

// first, second: of one window. look: see pt_compare_info. Throws Failure(ExitCode::usage) for pictures that cannot be
// tested.
LightVerdict test_light(const TestedImage &first, const TestedImage &second, const LightRule &rule,
                        std::uint32_t look = 0);

// The verdict, and the regions that differ most.
std::string light_text(const LightVerdict &verdict);
nlohmann::ordered_json light_json(const LightVerdict &verdict);

// A PNG of the differences of the smallest tiles in their standard deviations: red where the first picture is brighter,
// blue where it is darker, full at 8. Throws Failure(ExitCode::file).
void write_difference(const std::string &path, const LightVerdict &verdict);

} // namespace cli
