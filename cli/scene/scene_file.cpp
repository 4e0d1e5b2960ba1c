#include "cli/scene/scene_file.h"

#include "cli/base/exit_code.h"
#include "cli/base/json_path.h"
#include "cli/base/json_value.h"
#include "cli/base/report_file.h"
#include "cli/base/text_file.h"
#include "cli/scene/json_sections.h"
#include "cli/scene/scene_override.h"
#include "cli/scene/scene_place.h"
#include "cli/scene/scene_reader.h"

#include <algorithm>
#include <filesystem>
#include <functional>
#include <iterator>
#include <span>
#include <system_error>
#include <utility>

namespace cli {
namespace {

std::size_t hash_of(std::string_view text) {
    return std::hash<std::string_view>{}(text);
}

// The text that was read, if the file still holds it: one that was edited does not, and a pipe is read once.
std::optional<std::string> read_again(const SceneFile &scene) {
    std::error_code ignored;
    if (!std::filesystem::is_regular_file(scene.path, ignored))
        return std::nullopt;
    try {
        std::string text = read_file(scene.path);
        return hash_of(text) == scene.text_hash ? std::optional(std::move(text)) : std::nullopt;
    } catch (const Failure &) {
        return std::nullopt;
    }
}

pt_sphere_array coloured(std::span<const pt_sphere> spheres, std::span<const std::array<float, 3>> colours) {
    constexpr auto stride = static_cast<std::uint32_t>(sizeof(pt_sphere));
    pt_sphere_array array{};
    array.struct_size = sizeof array;
    array.count = static_cast<std::uint32_t>(spheres.size());
    array.center = {&spheres[0].center, stride, PT_TYPE_FLOAT64};
    array.radius = {&spheres[0].radius, stride, PT_TYPE_FLOAT64};
    array.motion = {&spheres[0].motion, stride, PT_TYPE_FLOAT64};
    array.material = {&spheres[0].material, stride, PT_TYPE_UINT32};
    array.color = {colours.data(), sizeof colours[0], PT_TYPE_FLOAT32};
    return array;
}

// What has taken the place of the file's value there; nullptr if nothing has.
const OverriddenValue *find_override(const SceneFile &scene, const JsonPath &path) {
    const auto found = std::find_if(scene.overridden.rbegin(), scene.overridden.rend(),
                                    [&](const OverriddenValue &each) { return is_within(path, each.path); });
    return found == scene.overridden.rend() ? nullptr : &*found;
}

// text: of the file, if it is known.
std::string explain_rule(const SceneFile &scene, const std::optional<std::string> &text, const BrokenRule &rule) {
    const JsonPath path = path_of(scene, rule);
    if (const OverriddenValue *value = find_override(scene, path))
        return value->source + ": " + rule_text(path_text(path), rule);
    const auto number = text && !path.empty() ? find_line(*text, path) : std::nullopt;
    return rule_text(place_text(scene.path, number, path.empty() ? field_text(rule) : path_text(path)), rule);
}

} // namespace

void SceneFile::add_sphere(const pt_sphere &sphere, const std::optional<std::array<float, 3>> &colour) {
    constexpr std::array<float, 3> white{1.0F, 1.0F, 1.0F};
    if (colour && sphere_colours.empty())
        sphere_colours.assign(spheres.size(), white);
    spheres.push_back(sphere);
    if (!sphere_colours.empty() || colour)
        sphere_colours.push_back(colour.value_or(white));
}

pt_scene SceneFile::scene() const {
    pt_scene scene{};
    scene.struct_size = sizeof(pt_scene);
    scene.material_count = static_cast<std::uint32_t>(materials.size());
    scene.sphere_count = sphere_colours.empty() ? static_cast<std::uint32_t>(spheres.size()) : 0;
    scene.plane_count = static_cast<std::uint32_t>(planes.size());
    scene.materials = materials.data();
    scene.spheres = spheres.data();
    scene.planes = planes.data();
    return scene;
}

std::vector<pt_sphere_array> SceneFile::sphere_arrays() const {
    std::vector<pt_sphere_array> arrays;
    if (!sphere_colours.empty())
        arrays.push_back(coloured(spheres, sphere_colours));
    std::transform(sphere_columns.begin(), sphere_columns.end(), std::back_inserter(arrays),
                   [](const SphereColumns &each) { return each.spheres(); });
    return arrays;
}

std::vector<std::uint32_t> SceneFile::material_flags() const {
    std::vector<std::uint32_t> flags(hidden_materials.empty() ? 0 : materials.size());
    for (const std::uint32_t material : hidden_materials)
        flags[material] = PT_MATERIAL_HIDDEN_FROM_CAMERA;
    return flags;
}

bool SceneFile::is_hidden(std::uint32_t material) const {
    return std::find(hidden_materials.begin(), hidden_materials.end(), material) != hidden_materials.end();
}

std::size_t SceneFile::item_of(std::size_t sphere) const {
    for (const SphereColumns &each : sphere_columns)
        sphere += each.item <= sphere ? 1 : 0;
    return sphere;
}

std::string SceneFile::explain(const BrokenRule &rule) const {
    return explain_rule(*this, read_again(*this), rule);
}

std::string SceneFile::explain(const LibraryError &error) const {
    if (error.rules.empty())
        return path + ": " + error.message;
    const std::optional<std::string> text = read_again(*this);
    return error.in_words([&](const BrokenRule &rule) { return explain_rule(*this, text, rule); });
}

ExitCode SceneFile::blame(const BrokenRule &rule) const {
    const OverriddenValue *value = find_override(*this, path_of(*this, rule));
    return value == nullptr ? ExitCode::scene : value->blame;
}

SceneFile parse_scene(std::string_view text, const std::string &path) {
    return parse_scene(text, path, {});
}

SceneFile parse_scene(std::string_view text, const std::string &path, const std::vector<SceneOverride> &overrides) {
    SceneFile scene{};
    scene.path = path;
    scene.text_hash = hash_of(text);
    SceneReader reader(scene);
    for (const SceneOverride &each : overrides)
        scene.overridden.push_back({each.path, each.source, each.blame});
    OverridingHandler handler(reader, overrides);
    const std::string_view checked = require_text(text, path);
    try {
        parse_json_sections(checked, path, handler);
        handler.finish();
        reader.finish();
    } catch (const JsonRefusal &refusal) {
        const auto line = find_line(checked, refusal.path, refusal.occurrence);
        throw Failure(ExitCode::scene, place_text(path, line, path_text(refusal.path)) + ": " + refusal.what());
    }
    return scene;
}

SceneFile read_scene_file(const std::string &path) {
    const SceneText scene = read_scene_text(path);
    SceneFile file = parse_scene(scene.text, scene.path);
    load_columns(file);
    return file;
}

SceneText read_scene_text(const std::string &path) {
    return path == standard_stream ? SceneText{"standard input", read_standard_input()}
                                   : SceneText{path, read_file(path)};
}

} // namespace cli
