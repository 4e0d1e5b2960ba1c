// The table of a scene file's keys. The reader, the JSON Schema, the options of `pt render` and the manual's rows
// follow from it.
#pragma once

#include "cli/base/json.h"
#include "cli/scene/scene_file.h"

#include <pt/pt.h>

#include <array>
#include <optional>
#include <span>
#include <string>
#include <string_view>

namespace cli {

// The scene being read, and its present element.
struct SceneItem {
    SceneFile &scene;
    pt_material material{};
    pt_sphere sphere{};
    double end[3]{}; // of a capsule; `sphere` is the other end
    std::optional<Look> look = std::nullopt;
    pt_plane plane{};
    std::string material_name{}; // of the sphere, capsule or plane
};

struct SceneKey {
    std::string_view name;
    ValueRule rule;
    std::string_view words;   // description
    std::string_view initial; // the default as written in a file; empty: none
    bool is_required;
    void (*store)(SceneItem &item, const nlohmann::json &value); // value keeps the rule
    std::string_view option = {};                                // of `pt render`; overrides the file
    pt_column pt_sphere_array::*column = nullptr;                // of many spheres' values, if a file may have them
};

enum class SectionForm {
    members, // of keys
    objects, // of named objects with these keys
    array    // of objects with these keys
};

struct SceneSection {
    std::string_view name;
    SectionForm form;
    std::string_view words;
    std::span<const SceneKey> keys;

    bool may_be_many() const; // whether an item may be many, by columns

    // Whether values may change between frames: camera, materials and surfaces.
    bool may_move() const { return form != SectionForm::members || name == "camera"; }
};

// All except `animation`, whose keys are paths.
std::span<const SceneSection> scene_sections();

const SceneSection *find_section(std::string_view name); // nullptr: none
const SceneKey *find_key(const SceneSection &section, std::string_view name);

std::vector<std::string_view> key_names(const SceneSection &section);

// text: without byte order mark. Throws JsonRefusal, or Failure for an override that does not fit or is refused.
void read_sections(SceneFile &scene, std::string_view text);

} // namespace cli
