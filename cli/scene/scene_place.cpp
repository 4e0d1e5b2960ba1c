#include "cli/scene/scene_place.h"

#include "cli/base/field_names.h"

#include <algorithm>
#include <array>
#include <string_view>

namespace cli {
namespace {

// Of what the file calls otherwise; empty if the file does not have it.
JsonPath renamed_path(const FieldName &name) {
    if (name.section.empty())
        return {};
    JsonPath path{{std::string(name.section), 0, false}, {std::string(name.key), 0, false}};
    if (name.element)
        path.push_back({{}, *name.element, true});
    return path;
}

// Of an element of a column, whose components are spheres. The file's single spheres may be an array before others.
JsonPath path_in_arrays(const SceneFile &scene, const BrokenRule &rule) {
    const std::size_t of_spheres = scene.sphere_colours.empty() ? 0 : 1;
    const bool is_single = *rule.index < of_spheres;
    const std::size_t item =
        is_single ? scene.item_of(rule.component.value_or(0)) : scene.sphere_columns[*rule.index - of_spheres].item;
    JsonPath path{{"spheres", 0, false}, {{}, item, true}, {rule.member, 0, false}};
    if (rule.component && !is_single)
        path.push_back({{}, *rule.component, true});
    return path;
}

// Of what the file calls as pt.h does, but for materials, which have names there; empty if it is none of the file's.
JsonPath path_of_member(const SceneFile &scene, const BrokenRule &rule) {
    if (rule.subject == "sphere_arrays" && rule.index)
        return path_in_arrays(scene, rule);
    static constexpr std::array<std::string_view, 5> sections{"camera", "render", "materials", "spheres", "planes"};
    if (std::find(sections.begin(), sections.end(), rule.subject) == sections.end())
        return {};
    JsonPath path{{rule.subject, 0, false}};
    if (rule.index) {
        const bool is_named = rule.subject == "materials" && *rule.index < scene.material_names.size();
        const std::size_t item = rule.subject == "spheres" ? scene.item_of(*rule.index) : *rule.index;
        path.push_back(is_named ? JsonStep{scene.material_names[item], 0, false} : JsonStep{{}, item, true});
    }
    path.push_back({rule.member, 0, false});
    return path;
}

} // namespace

std::string place_text(const std::string &file, std::optional<std::size_t> line, const std::string &path) {
    std::string text = file;
    if (line)
        text.append(":").append(std::to_string(*line));
    if (!path.empty())
        text.append(": ").append(path);
    return text;
}

JsonPath path_of(const SceneFile &scene, const BrokenRule &rule) {
    const FieldName *name = find_field_name(rule);
    JsonPath path = name != nullptr ? renamed_path(*name) : path_of_member(scene, rule);
    if (!path.empty() && rule.component && rule.subject != "sphere_arrays")
        path.push_back({{}, *rule.component, true});
    return path;
}

} // namespace cli
