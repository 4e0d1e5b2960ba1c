#include "cli/compare/light.h"

#include "cli/base/context.h"
#include "cli/base/json.h"
#include "cli/base/text.h"
#include "cli/image/image_file.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>

namespace cli {
namespace {

pt_compared_image compared_image(const TestedImage &image) {
    pt_compared_image compared{};
    compared.radiance = image.radiance.data();
    compared.min_samples = image.min_samples;
    compared.max_samples = image.max_samples;
    compared.sampler = image.sampler;
    compared.estimator = image.estimator;
    return compared;
}

// For example "max_samples = 20: must be ...". The library's "second" becomes "the reference".
std::string rule_of(const LibraryError &error) {
    return error.in_words([](const BrokenRule &rule) {
        return std::string(rule.subject == "second" ? "the reference: " : "") + rule.text(rule.member);
    });
}

std::vector<pt_compared_region> worst_regions(const LightVerdict &verdict) {
    constexpr std::size_t most = 5;
    std::vector<pt_compared_region> worst;
    for (const pt_compared_region &region : verdict.regions)
        if (region.probability <= verdict.comparison.rate)
            worst.push_back(region);
    std::ranges::stable_sort(worst, {}, &pt_compared_region::probability);
    worst.resize(std::min(worst.size(), most));
    return worst;
}

std::string numbers_text(const double (&values)[3]) {
    return formatted("(%.3g, %.3g, %.3g)", values[0], values[1], values[2]);
}

nlohmann::ordered_json region_json(const LightVerdict &verdict, const pt_compared_region &region) {
    return {{"x", verdict.window.part.x + region.x},
            {"y", verdict.window.part.y + region.y},
            {"width", region.width},
            {"height", region.height},
            {"light", region.light},
            {"difference", region.difference},
            {"deviation", region.deviation},
            {"probability", region.probability},
            {"smallest_change", number_or_null(region.smallest_change)}};
}

// The largest difference of a channel, in standard deviations.
double signed_difference(const pt_compared_region &region) {
    double greatest = 0.0;
    for (std::size_t channel = 0; channel < 3; ++channel) {
        const double deviation = region.deviation[channel];
        const double z = deviation > 0.0 ? region.difference[channel] / deviation : 0.0;
        greatest = std::abs(z) > std::abs(greatest) ? z : greatest;
    }
    return greatest;
}

// White if the light is equal.
std::array<std::uint8_t, 3> color_of(double z) {
    constexpr double full = 8.0;
    const auto rest = static_cast<std::uint8_t>(std::lround(255.0 * (1.0 - std::min(std::abs(z) / full, 1.0))));
    return z > 0.0 ? std::array<std::uint8_t, 3>{255, rest, rest} : std::array<std::uint8_t, 3>{rest, rest, 255};
}

} // namespace

LightVerdict test_light(const TestedImage &first, const TestedImage &second, const LightRule &rule,
                        std::uint32_t look) {
    auto info = sized<pt_compare_info>();
    info.width = first.window.part.width;
    info.height = first.window.part.height;
    info.look = look;
    info.first = compared_image(first);
    info.second = compared_image(second);
    info.rate = rule.rate.value_or(0.0);
    info.min_change = rule.min_change.value_or(0.0);
    LightVerdict verdict{sized<pt_comparison>(), {}, first.window};
    std::uint32_t count = 0;
    const auto compare = [&](pt_comparison *comparison, pt_compared_region *regions) {
        if (pt_compare(&info, comparison, regions, &count) < 0)
            throw Failure(ExitCode::usage, "cannot test the light: " + rule_of(last_error(nullptr)));
    };
    compare(nullptr, nullptr);
    verdict.regions.resize(count);
    compare(&verdict.comparison, verdict.regions.data());
    return verdict;
}

std::string light_text(const LightVerdict &verdict) {
    std::string text = std::string(verdict.comparison.summary) + "\n";
    for (const pt_compared_region &region : worst_regions(verdict))
        text += concat("  ", region.width, "x", region.height, " pixels at ", verdict.window.part.x + region.x, ",",
                       verdict.window.part.y + region.y, ": difference ", numbers_text(region.difference), " +- ",
                       numbers_text(region.deviation), " of ", numbers_text(region.light), "\n");
    return text;
}

nlohmann::ordered_json light_json(const LightVerdict &verdict) {
    constexpr std::array<const char *, 5> names{"", "equal bits", "same", "different", "undecided"};
    const pt_comparison &comparison = verdict.comparison;
    auto regions = nlohmann::ordered_json::array();
    for (const pt_compared_region &region : verdict.regions)
        regions.push_back(region_json(verdict, region));
    return {{"light", names.at(comparison.light)},
            {"summary", comparison.summary},
            {"rate", comparison.rate},
            {"probability", comparison.probability},
            {"smallest_change", number_or_null(comparison.smallest_change)},
            {"smallest_tile_change", number_or_null(comparison.smallest_tile_change)},
            {"regions", std::move(regions)}};
}

// Later regions are smaller, and overwrite larger ones.
void write_difference(const std::string &path, const LightVerdict &verdict) {
    const Rectangle &part = verdict.window.part;
    std::vector<std::uint8_t> signals(3 * part.pixel_count());
    for (const pt_compared_region &region : verdict.regions) {
        const std::array<std::uint8_t, 3> color = color_of(signed_difference(region));
        for (std::uint32_t y = region.y; y < region.y + region.height; ++y)
            for (std::uint32_t x = region.x; x < region.x + region.width; ++x)
                std::ranges::copy(color, &signals[3 * (std::size_t{y} * part.width + x)]);
    }
    ImageWriter().write(image_target(path, std::nullopt), {.window = verdict.window, .signals = signals});
}

} // namespace cli
