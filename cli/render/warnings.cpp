#include "cli/render/warnings.h"

#include "cli/base/text.h"
#include "lib/scene/srgb.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>
#include <optional>
#include <utility>

namespace cli {
namespace {

bool emits(const pt_material &material) {
    return std::any_of(std::begin(material.emission), std::end(material.emission), [](float x) { return x > 0.0F; });
}

bool is_lit(const SceneFile &scene) {
    return std::ranges::any_of(scene.used_materials, [&](std::uint32_t i) { return emits(scene.materials[i]); });
}

// At normal incidence a lobe reflects its whole weight.
float reflected_share(const pt_material &material) {
    float largest = 0.0F;
    for (std::size_t i = 0; i < 3; ++i)
        largest = std::max(largest, material.diffuse[i] + material.specular[i]);
    return largest;
}

std::string byte_color_text(const pt_material &material) {
    std::array<std::string, 3> bytes;
    std::array<std::string, 3> shares;
    const auto is_byte = [](float number) {
        return number >= 0.0F && number <= 255.0F && number == std::floor(number);
    };
    const bool is_color = std::ranges::all_of(material.diffuse, is_byte) && std::ranges::max(material.diffuse) > 1.0F;
    for (std::size_t i = 0; i < 3 && is_color; ++i) {
        bytes[i] = formatted("%.0f", material.diffuse[i]);
        shares[i] = formatted("%.3g", pt::srgb::decoded(material.diffuse[i] / 255.0));
    }
    return is_color ? concat("; the sRGB color ", listed(bytes), " is [", listed(shares), "]") : "";
}

std::optional<std::string> brightening_materials(const SceneFile &scene) {
    constexpr float tolerance = 1e-6F; // in floats 0.1 + 0.9 may exceed 1
    constexpr std::size_t most_names = 3;
    std::vector<std::string> names;
    std::string hint;
    std::size_t count = 0;
    float largest = 0.0F;
    for (const std::uint32_t i : scene.used_materials) {
        const float share = reflected_share(scene.materials[i]);
        if (!(share > 1.0F + tolerance))
            continue;
        if (count == 0)
            hint = byte_color_text(scene.materials[i]);
        if (++count <= most_names)
            names.push_back(pt::path_text({{"materials"}, {scene.material_names[i]}}));
        largest = std::max(largest, share);
    }
    if (count == 0)
        return std::nullopt;
    return listed(names) + (count > most_names ? concat(" and ", count - most_names, " more") : "") +
           ": diffuse + specular = " + formatted("%.3g", largest) + (count == 1 ? "" : " at most") +
           ": more light is reflected than received" + hint;
}

bool is_black(std::span<const float> radiance) {
    return !radiance.empty() && std::ranges::all_of(radiance, [](float value) { return value == 0.0F; });
}

// Relative errors count light below 0.1 as 0.1 (pt_error_estimate). A dark picture therefore has small relative errors
// even if it is noisy.
std::optional<std::string> picture_below_its_target(const RenderReport &report, std::span<const float> radiance) {
    // At this limit the picture's average is 0.18 / 2^4.5 = 0.008. A target of 1% permits noise of 1% of 0.1.
    constexpr double most_stops = 4.5;
    if (report.target_error <= 0.0 || is_black(radiance))
        return std::nullopt;
    const bool is_known = report.tone_map && report.tone_map->is_automatic;
    const double stops = is_known ? report.tone_map->display.exposure : automatic_exposure(radiance);
    if (stops <= most_stops)
        return std::nullopt;
    return "--error: the picture is so dark that a relative error says little: "
           "multiply all emission by 2^" +
           formatted("%.0f", stops) + ", or ask for much less";
}

bool is_known_to_be_black(const RenderReport &report) {
    return std::ranges::any_of(report.warnings,
                               [](const auto &warning) { return warning.ends_with("the picture is black"); });
}

} // namespace

std::vector<std::string> input_warnings(const SceneFile &scene, const std::optional<BrokenRule> &of_library,
                                        double target_error) {
    std::vector<std::string> warnings;
    if (!is_lit(scene))
        warnings.push_back(scene.path + ": no surface emits light: the picture is black");
    if (const auto materials = brightening_materials(scene))
        warnings.push_back(scene.path + ": " + *materials);
    if (of_library)
        warnings.push_back(explain(scene, *of_library));
    if (target_error >= 1.0) {
        warnings.push_back("--error: the target is " + percent_text(target_error) +
                           "; two percent are written 2% or 0.02");
    }
    return warnings;
}

std::vector<std::string> image_warnings(const RenderReport &report, std::span<const float> radiance) {
    std::vector<std::string> warnings;
    const pt_stats &stats = report.stats;
    if (stats.rejected_samples > 0) {
        const double pixel_count = static_cast<double>(report.render.width) * report.window.part.height; // whole rows
        const double sample_count = pixel_count * stats.sample_count;
        const double share = static_cast<double>(stats.rejected_samples) / sample_count;
        warnings.push_back(counted(stats.rejected_samples, "sample") + " (" + percent_text(share) +
                           ") were left out: not finite, negative or too bright");
    }
    if (auto below = picture_below_its_target(report, radiance))
        warnings.push_back(std::move(*below));
    if (is_black(radiance) && !is_known_to_be_black(report))
        warnings.emplace_back(
            "no sample hit light: the picture is black, and the stated error of 0 says nothing; is the "
            "camera inside a ball, or every lamp behind a surface?");
    return warnings;
}

void print_warnings(std::span<const std::string> warnings) {
    for (const std::string &warning : warnings)
        print_message("warning: " + warning);
}

} // namespace cli
