#include "cli/render/warnings.h"

#include "cli/base/json_path.h"
#include "cli/base/message.h"
#include "cli/base/text.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <iterator>
#include <optional>
#include <utility>

namespace cli {
namespace {

using Vector = std::array<double, 3>;

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

Vector center_at(const pt_sphere &sphere, double time) {
    Vector center{};
    for (std::size_t i = 0; i < 3; ++i)
        center[i] = sphere.center[i] + time * sphere.motion[i];
    return center;
}

double distance(const Vector &a, const Vector &b) {
    return std::hypot(a[0] - b[0], a[1] - b[1], a[2] - b[2]);
}

// Bounds of the distance of the centres while the shutter is open. Seen from b, a moves on a straight way: it is
// farthest from b at an end of the way, and never farther from the nearest end than half of its length.
std::pair<double, double> distances(const pt_sphere &a, const pt_sphere &b, double open, double close) {
    const auto at = [&](double time) { return distance(center_at(a, time), center_at(b, time)); };
    const auto [near, far] = std::minmax({at(open), at(close)});
    Vector way{};
    for (std::size_t i = 0; i < 3; ++i)
        way[i] = (close - open) * (a.motion[i] - b.motion[i]);
    return {near - 0.5 * std::hypot(way[0], way[1], way[2]), far};
}

// Looks for a ball that shuts the camera in. Surfaces let no light through, so that it is dark inside unless a part of
// a lamp's surface is inside too; a lamp that is wholly around the ball or wholly outside has none there.
class ShutInCamera {
public:
    explicit ShutInCamera(const SceneFile &scene) : scene_(scene) {
        const pt_camera &camera = scene.camera;
        position_ = {camera.position[0], camera.position[1], camera.position[2]};
        open_ = shutter_of(camera)[0];
        close_ = shutter_of(camera)[1];
    }

    // Index of a sphere that the camera is inside of as long as the shutter is open, and that holds no light.
    std::optional<std::size_t> find() const {
        for (std::size_t i = 0; i < scene_.spheres.size(); ++i) {
            const pt_sphere &ball = scene_.spheres[i];
            const bool is_dark = !emits(material_of(ball)) && !scene_.is_hidden(ball.material);
            if (is_dark && surrounds_camera(ball) && !holds_light(ball))
                return i;
        }
        return std::nullopt;
    }

private:
    template <typename Surface>
    const pt_material &material_of(const Surface &surface) const {
        return scene_.materials[surface.material];
    }

    // What is true at both ends of a straight way is true in between: a ball is convex.
    bool surrounds_camera(const pt_sphere &ball) const {
        return std::max(distance(center_at(ball, open_), position_), distance(center_at(ball, close_), position_)) <
               ball.radius;
    }

    bool holds_light(const pt_sphere &ball) const {
        const auto sphere_reaches_in = [&](const pt_sphere &lamp) {
            const auto [near, far] = distances(lamp, ball, open_, close_);
            return emits(material_of(lamp)) && near <= lamp.radius + ball.radius && lamp.radius <= far + ball.radius;
        };
        const auto plane_reaches_in = [&](const pt_plane &lamp) {
            const auto height = [&](double time) {
                const Vector center = center_at(ball, time);
                const auto &n = lamp.normal;
                return (n[0] * center[0] + n[1] * center[1] + n[2] * center[2] + lamp.offset) /
                       std::hypot(n[0], n[1], n[2]);
            };
            const auto [low, high] = std::minmax({height(open_), height(close_)});
            return emits(material_of(lamp)) && low <= ball.radius && high >= -ball.radius;
        };
        // Where spheres of columns shine is not looked at: they may be millions.
        const auto columns_shine = [this](const SphereColumns &each) { return emits(material_of(each)); };
        return std::any_of(scene_.sphere_columns.begin(), scene_.sphere_columns.end(), columns_shine) ||
               std::any_of(scene_.spheres.begin(), scene_.spheres.end(), sphere_reaches_in) ||
               std::any_of(scene_.planes.begin(), scene_.planes.end(), plane_reaches_in);
    }

    const SceneFile &scene_;
    Vector position_;
    double open_;
    double close_;
};

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
    std::string names;
    std::size_t count = 0;
    float largest = 0.0F;
    for (std::size_t i = 0; i < used.size(); ++i) {
        const float share = reflected_share(scene.materials[i]);
        if (!used[i] || !(share > 1.0F + tolerance))
            continue;
        if (++count <= most_names) {
            names.append(count == 1 ? "" : ", ");
            names.append(path_text({{"materials"}, {scene.material_names[i]}}));
        }
        largest = std::max(largest, share);
    }
    if (count == 0)
        return std::nullopt;
    if (count > most_names)
        names.append(" and ").append(std::to_string(count - most_names)).append(" more");
    return names + ": diffuse + specular = " + formatted("%.3g", largest) + (count == 1 ? "" : " at the most") +
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
    const std::string hint = report.automatic_exposure
                                 ? "a lower --exposure than " + formatted("%.2f", report.tone_map->exposure)
                                 : "--exposure auto, here " + formatted("%.2f", automatic_exposure(radiance));
    return formatted("%.0f%%", 100.0 * share) + " of the pixels are burnt out, with a channel at its maximum: try " +
           hint + (report.tone_map->curve == ToneCurve::none ? ", or --tonemap agx" : "");
}

bool is_black(std::span<const float> radiance) {
    return !radiance.empty() &&
           std::all_of(radiance.begin(), radiance.end(), [](float value) { return value == 0.0F; });
}

// Whether a warning before has said so.
bool is_known_to_be_black(const RenderReport &report) {
    return std::any_of(report.warnings.begin(), report.warnings.end(),
                       [](const std::string &warning) { return warning.ends_with("the picture is black"); });
}

} // namespace

std::vector<std::string> input_warnings(const SceneFile &scene, double target_error) {
    std::vector<std::string> warnings;
    if (!is_lit(scene)) {
        warnings.push_back(scene.path + ": no surface emits light: the picture is black");
    } else if (const auto ball = ShutInCamera(scene).find()) {
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
    if (is_black(radiance) && !is_known_to_be_black(report))
        warnings.emplace_back("no sample met light: the picture is black, and the stated error of 0 says nothing");
    return warnings;
}

void print_warnings(std::span<const std::string> warnings) {
    for (const std::string &warning : warnings)
        print_message("warning: " + warning);
}

} // namespace cli
