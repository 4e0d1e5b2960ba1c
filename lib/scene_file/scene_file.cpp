#include "lib/scene_file/scene_file.h"

#include "lib/platform/printable.h"
#include "lib/scene_file/json_items.h"
#include "lib/scene_file/read_file.h"
#include "lib/scene_file/scene_keys.h"
#include "lib/scene_file/text.h"

#include <algorithm>
#include <charconv>
#include <iterator>
#include <string>
#include <utility>

namespace pt {
namespace {

constexpr std::array<std::array<std::string_view, 2>, 6> renamed{{{"camera.target", "camera.look_at"},
                                                                  {"camera.shutter_open", "camera.shutter[0]"},
                                                                  {"camera.shutter_close", "camera.shutter[1]"},
                                                                  {"render.width", "film.width"},
                                                                  {"render.height", "film.height"},
                                                                  {"accumulate.sample_count", "render.spp"}}};

// Single spheres and capsules may also form arrays. These come before items of many spheres.
JsonPath path_in_arrays(const SceneFile &scene, const BrokenRule &rule) {
    const std::size_t of_spheres = scene.sphere_items.items.empty() ? 0 : 1;
    const std::size_t of_single = of_spheres + (scene.capsules.items.empty() ? 0 : 1);
    const auto array = static_cast<std::size_t>(rule.index);
    const auto element = static_cast<std::size_t>(std::max(rule.component, 0));
    const bool is_single = array < of_single;
    if (array >= of_single + scene.sphere_columns.size())
        return {};
    const SphereColumns *const many = is_single ? nullptr : &scene.sphere_columns[array - of_single];
    const std::string_view section = many ? many->section : array < of_spheres ? "spheres" : "capsules";
    const std::size_t item = many ? many->item : scene.item_of(section, element);
    JsonPath path{{std::string(section)}, {{}, item, true}, {rule.member}};
    if (rule.component >= 0 && !is_single && rule.member != "material") // one value for all spheres
        path.push_back({{}, element, true});
    return path;
}

BrokenRule with_names(const SceneFile &scene, const BrokenRule &rule) {
    BrokenRule named = rule;
    named.value = platform::printable(rule.value);
    std::size_t material = 0;
    const char *const end = rule.value.data() + rule.value.size();
    const auto read = std::from_chars(rule.value.data(), end, material);
    const bool is_material = read.ec == std::errc{} && read.ptr == end && material < scene.material_names.size();
    if (rule.subject == "sphere_arrays" && rule.member == "material" && is_material)
        named.value = platform::printable(concat('"', scene.material_names[material], '"'));
    return named;
}

JsonPath path_of(const SceneFile &scene, const BrokenRule &rule) {
    if (rule.subject == "sphere_arrays" && rule.index >= 0)
        return path_in_arrays(scene, rule);
    const std::string name = rule.subject + "." + rule.member;
    JsonPath path;
    if (const auto found = std::ranges::find_if(renamed, [&](const auto &each) { return each[0] == name; });
        found != renamed.end()) {
        path = parse_path((*found)[1]).value().path;
    } else if (find_section(rule.subject) == nullptr) {
        return {};
    } else {
        path.push_back({rule.subject});
        if (rule.index >= 0) {
            const auto index = static_cast<std::size_t>(rule.index);
            const bool is_named = rule.subject == "materials" && index < scene.material_names.size();
            const std::size_t item = rule.subject == "spheres" ? scene.item_of("spheres", index) : index;
            path.push_back(is_named ? JsonStep{scene.material_names[item]} : JsonStep{{}, item, true});
        }
        path.push_back({rule.member});
    }
    if (rule.component >= 0)
        path.push_back({{}, static_cast<std::size_t>(rule.component), true});
    return path;
}

const SceneOverride *find_override(const SceneFile &scene, const JsonPath &path) {
    const auto found = std::find_if(scene.overrides.rbegin(), scene.overrides.rend(),
                                    [&](const SceneOverride &each) { return is_within(path, each.path); });
    return found == scene.overrides.rend() ? nullptr : &*found;
}

} // namespace

pt_scene SceneFile::scene() const {
    auto scene = sized<pt_scene>();
    scene.material_count = static_cast<std::uint32_t>(materials.size());
    scene.sphere_count = static_cast<std::uint32_t>(spheres.size());
    scene.plane_count = static_cast<std::uint32_t>(planes.size());
    scene.materials = materials.data();
    scene.spheres = spheres.data();
    scene.planes = planes.data();
    return scene;
}

std::vector<pt_sphere_array> SceneFile::sphere_arrays() const {
    std::vector<pt_sphere_array> arrays;
    for (const SphereItems *single : {&sphere_items, &capsules})
        if (!single->items.empty())
            arrays.push_back(single->array());
    std::transform(sphere_columns.begin(), sphere_columns.end(), std::back_inserter(arrays),
                   [](const SphereColumns &each) { return each.spheres(); });
    return arrays;
}

std::size_t SceneFile::item_of(std::string_view section, std::size_t index) const {
    for (const SphereColumns &each : sphere_columns)
        index += each.section == section && each.item <= index ? 1 : 0;
    return index;
}

bool SceneFile::gives(const JsonPath &key) const {
    return std::ranges::any_of(given, [&](const JsonPath &each) { return is_within(key, each); });
}

bool SceneFile::gives(const BrokenRule &rule) const {
    const JsonPath path_there = path_of(*this, rule);
    return find_override(*this, path_there) != nullptr || (!path_there.empty() && gives(path_there));
}

RuleSource SceneFile::source_of(const BrokenRule &rule) const {
    const JsonPath path_there = path_of(*this, rule);
    const BrokenRule named = with_names(*this, rule);
    if (const SceneOverride *cause = find_override(*this, path_there))
        return {named.text(cause->name_of(path_there)), 0, cause};
    const std::size_t line = path_there.empty() ? 0 : line_of(text, path_there).value_or(0);
    const std::string place = line == 0 ? path : concat(path, ":", line);
    return {named.text(place + ": " + (path_there.empty() ? rule.field() : path_text(path_there))), line};
}

pt_result SceneFile::blame(const BrokenRule &rule) const {
    const SceneOverride *cause = find_override(*this, path_of(*this, rule));
    return cause != nullptr ? cause->blame : PT_ERROR_INVALID_SCENE;
}

SceneFile scene_of_text(std::string text, const std::string &path, std::vector<SceneOverride> overrides) {
    SceneFile scene;
    scene.path = path;
    scene.text = std::move(text);
    scene.overrides = std::move(overrides);
    try {
        read_sections(scene, require_text(scene.text, path));
    } catch (const JsonRefusal &refusal) {
        const auto line = line_of(scene.text, refusal.cause);
        const std::string name = path_text(refusal.path);
        throw Error(PT_ERROR_INVALID_SCENE, path + (line ? ":" + std::to_string(*line) : "") +
                                                (name.empty() ? "" : ": " + name) + ": " + refusal.what());
    }
    return scene;
}

SceneFile scene_of_file(const std::string &path, std::vector<SceneOverride> overrides) {
    const auto read = [](platform::InputFile &file) { return file.text(); };
    return scene_of_text(read_file(path, read), path, std::move(overrides));
}

} // namespace pt
