#pragma once

#include "cli/image/image_module.h"

#include <pt/compare.h>

#include <nlohmann/json.hpp>

#include <optional>
#include <span>
#include <string>
#include <vector>

namespace cli {

struct TestedImage {
    ImageWindow window;
    std::span<const float> radiance; // three values a pixel
    std::uint32_t min_samples;       // fewest samples of a pixel
    std::uint32_t max_samples;
    std::uint32_t sampler;   // PT_SAMPLER_*, 0 if unknown
    std::uint32_t estimator; // PT_ESTIMATOR_*, 0 if unknown
};

struct LightRule {
    std::optional<double> rate;
    std::optional<double> min_change;
};

struct LightVerdict {
    pt_comparison comparison;
    std::vector<pt_compared_region> regions;
    ImageWindow window;

    bool is_different() const { return comparison.light == PT_LIGHT_DIFFERENT; }
    bool is_decided() const { return comparison.light != PT_LIGHT_UNDECIDED; }
};

// Both images must show the same window. pt_compare_info describes `look`. Throws Failure(ExitCode::usage) for images
// that cannot be tested.
LightVerdict test_light(const TestedImage &first, const TestedImage &second, const LightRule &rule,
                        std::uint32_t look = 0);

std::string light_text(const LightVerdict &verdict);
nlohmann::ordered_json light_json(const LightVerdict &verdict);

// Writes a PNG of the smallest tiles' differences in standard deviations: red where the first picture is brighter, blue
// where it is darker, saturated at 8. Throws Failure(ExitCode::file).
void write_difference(const std::string &path, const LightVerdict &verdict);

} // namespace cli
