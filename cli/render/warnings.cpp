#include "cli/render/warnings.h"

#include "cli/base/json.h"
#include "cli/base/text.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <iterator>
#include <optional>
#include <utility>

namespace cli {
namespace {

bool emits(const pt_material &material) {
    return std::any_of(std::begin(material.emission), std::end(material.emission), [](float x) { return x > 0.0F; });
}

// For each material, whether a surface is made of it.
std::vector<bool> used_materials(const SceneFile &scene) {
    std::vector<bool> used(scene.materials.size());
    for (const pt_sphere &sphere : scene.spheres)
        used[sphere.material] = true;
    for (const SphereColumns &each : scene.sphere_columns)
        used[each.material] = true;
    for (const pt_plane &plane : scene.planes)
        used[plane.material] = true;
    return used;
}

bool is_lit(const SceneFile &scene) {
    const std::vector<bool> used = used_materials(scene);
    for (std::size_t i = 0; i < used.size(); ++i)
        if (used[i] && emits(scene.materials[i]))
            return true;
    return false;
}

double distance(const double (&a)[3], const double (&b)[3]) {
    return std::hypot(a[0] - b[0], a[1] - b[1], a[2] - b[2]);
}

bool moves(const pt_sphere &sphere) {
    return std::any_of(std::begin(sphere.motion), std::end(sphere.motion), [](double x) { return x != 0.0; });
}

// Index of a sphere that the camera is inside of, and that holds no light. Surfaces let no light through, so that it is
// dark inside unless a part of a lamp's surface is inside too; a lamp that is wholly around the ball or wholly outside
// has none there. Balls and lamps that move are taken to be lit, and lamps of columns to be everywhere.
std::optional<std::size_t> dark_ball_around_camera(const SceneFile &scene) {
    const auto shines = [&](const auto &surface) { return emits(scene.materials[surface.material]); };
    const auto is_dark = [&](const pt_sphere &ball) {
        const auto sphere_reaches_in = [&](const pt_sphere &lamp) {
            const double way = distance(lamp.center, ball.center);
            return shines(lamp) &&
                   (moves(lamp) || (way <= lamp.radius + ball.radius && lamp.radius <= way + ball.radius));
        };
        const auto plane_reaches_in = [&](const pt_plane &lamp) {
            const auto &n = lamp.normal;
            const double height = n[0] * ball.center[0] + n[1] * ball.center[1] + n[2] * ball.center[2] + lamp.offset;
            return shines(lamp) && std::abs(height) <= ball.radius * std::hypot(n[0], n[1], n[2]);
        };
        return !shines(ball) && !moves(ball) &&
               scene.materials[ball.material].flags != PT_MATERIAL_HIDDEN_FROM_CAMERA &&
               distance(scene.camera.position, ball.center) < ball.radius &&
               std::ranges::none_of(scene.sphere_columns, shines) &&
               std::ranges::none_of(scene.spheres, sphere_reaches_in) &&
               std::ranges::none_of(scene.planes, plane_reaches_in);
    };
    const auto ball = std::ranges::find_if(scene.spheres, is_dark);
    return ball == scene.spheres.end() ? std::nullopt
                                       : std::optional(static_cast<std::size_t>(ball - scene.spheres.begin()));
}

// The largest of the channels' sums. Specular lobes reflect all of their weight where light falls in along the normal.
float reflected_share(const pt_material &material) {
    float largest = 0.0F;
    for (std::size_t i = 0; i < 3; ++i)
        largest = std::max(largest, material.diffuse[i] + material.specular[i]);
    return largest;
}

std::optional<std::string> brightening_materials(const SceneFile &scene) {
    constexpr float tolerance = 1e-6F; // 0.1 + 0.9 in float32 may pass 1
    constexpr std::size_t most_names = 3;
    const std::vector<bool> used = used_materials(scene);
    std::vector<std::string> names;
    std::size_t count = 0;
    float largest = 0.0F;
    for (std::size_t i = 0; i < used.size(); ++i) {
        const float share = reflected_share(scene.materials[i]);
        if (!used[i] || !(share > 1.0F + tolerance))
            continue;
        if (++count <= most_names)
            names.push_back(path_text({{"materials"}, {scene.material_names[i]}}));
        largest = std::max(largest, share);
    }
    if (count == 0)
        return std::nullopt;
    return listed(names) + (count > most_names ? concat(" and ", count - most_names, " more") : "") +
           ": diffuse + specular = " + formatted("%.3g", largest) + (count == 1 ? "" : " at the most") +
           ": more light is reflected than received";
}

// Looks at every n-th pixel, some 65,536 at most, which is enough to estimate a share.
double burnt_out_share(std::span<const float> radiance, const ToneMap &tone_map) {
    constexpr std::size_t most_pixels = 65'536;
    const std::size_t pixel_count = radiance.size() / 3;
    const std::size_t step = (pixel_count + most_pixels - 1) / most_pixels;
    std::vector<float> chosen;
    for (std::size_t pixel = 0; pixel < pixel_count; pixel += step)
        chosen.insert(chosen.end(), {radiance[3 * pixel], radiance[3 * pixel + 1], radiance[3 * pixel + 2]});
    const std::vector<std::uint8_t> bytes = map_to_8_bits(chosen, tone_map);
    std::size_t count = 0;
    for (std::size_t i = 0; i < bytes.size(); i += 3)
        count += std::max({bytes[i], bytes[i + 1], bytes[i + 2]}) == 255 ? 1 : 0;
    return static_cast<double>(3 * count) / static_cast<double>(std::max<std::size_t>(bytes.size(), 1));
}

std::optional<std::string> burnt_out_picture(const RenderReport &report, std::span<const float> radiance) {
    constexpr double largest_share = 0.25;
    if (!report.tone_map)
        return std::nullopt;
    const double share = burnt_out_share(radiance, *report.tone_map);
    if (!(share > largest_share))
        return std::nullopt;
    const std::string hint = report.tone_map->is_automatic
                                 ? "a lower --exposure than " + formatted("%.2f", report.tone_map->exposure)
                                 : "--exposure auto, here " + formatted("%.2f", automatic_exposure(radiance));
    return formatted("%.0f%%", 100.0 * share) + " of the pixels are burnt out, with a channel at its maximum: try " +
           hint + (report.tone_map->curve == ToneCurve::none ? ", or --tonemap agx" : "");
}

bool is_black(std::span<const float> radiance) {
    return !radiance.empty() && std::ranges::all_of(radiance, [](float value) { return value == 0.0F; });
}

// In the relative error light far below 0.1 counts as none (pt_error_estimate), so a picture that is dark all over is
// on target with any noise. Pictures of the units that light meters have may be, where emission is some hundredths of a
// unit; scaling all emission scales the picture, and its noise, to the bit.
std::optional<std::string> picture_below_its_target(const RenderReport &report, std::span<const float> radiance) {
    constexpr double most_stops = 4.5; // the average is below a twelfth of 0.1
    if (report.target_error <= 0.0 || is_black(radiance))
        return std::nullopt;
    const double stops = automatic_exposure(radiance);
    if (stops <= most_stops)
        return std::nullopt;
    return "--error: the picture is darker than what the relative error tells apart, so the target says little of it: "
           "multiply all emission by 2^" +
           formatted("%.0f", stops) + ", or ask for much less";
}

// Whether a warning before has said so.
bool is_known_to_be_black(const RenderReport &report) {
    return std::ranges::any_of(report.warnings,
                               [](const auto &warning) { return warning.ends_with("the picture is black"); });
}

} // namespace

std::vector<std::string> input_warnings(const SceneFile &scene, double target_error) {
    std::vector<std::string> warnings;
    if (!is_lit(scene)) {
        warnings.push_back(scene.path + ": no surface emits light: the picture is black");
    } else if (const auto ball = dark_ball_around_camera(scene)) {
        warnings.push_back(scene.path + ": the camera is inside of spheres[" + std::to_string(scene.item_of(*ball)) +
                           "], which no light gets into: the picture is black");
    }
    if (const auto materials = brightening_materials(scene))
        warnings.push_back(scene.path + ": " + *materials);
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
        const double pixel_count =
            static_cast<double>(report.render.width) * report.window.part.height; // of whole rows
        const double sample_count = pixel_count * stats.sample_count;
        const double share = static_cast<double>(stats.rejected_samples) / sample_count;
        warnings.push_back(std::to_string(stats.rejected_samples) + " samples (" + percent_text(share) +
                           ") were left out: not finite, negative or too bright");
    }
    if (auto burnt_out = burnt_out_picture(report, radiance))
        warnings.push_back(std::move(*burnt_out));
    if (auto below = picture_below_its_target(report, radiance))
        warnings.push_back(std::move(*below));
    if (is_black(radiance) && !is_known_to_be_black(report))
        warnings.emplace_back("no sample met light: the picture is black, and the stated error of 0 says nothing");
    return warnings;
}

void print_warnings(std::span<const std::string> warnings) {
    for (const std::string &warning : warnings)
        print_message("warning: " + warning);
}

} // namespace cli
