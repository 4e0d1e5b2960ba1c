// The table of all that a scene file can say: each key with its values, its words and where it goes. The reader, the
// JSON Schema, the options of `pt render` that give the same, and the manual's rows follow from it.
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

// What is being read: the scene, and the element of it that is not complete yet.
struct SceneItem {
    SceneFile &scene;
    pt_material material{};
    pt_sphere sphere{};
    double end[3]{}; // of a capsule, whose other end is the sphere
    std::optional<Look> look = std::nullopt;
    pt_plane plane{};
    std::string material_name{}; // of the sphere, capsule or plane
};

struct SceneKey {
    std::string_view name;
    ValueRule rule;
    std::string_view words;   // what it is
    std::string_view initial; // the default, as it is written in a file; empty: none
    bool is_required;
    void (*store)(SceneItem &item, const nlohmann::json &value); // one that keeps the rule
    std::string_view option = {};                                // of `pt render`, which counts before the file
    pt_column pt_sphere_array::*column = nullptr; // where the values of many spheres go, if a file may have them
};

enum class SectionForm {
    members, // its members are the keys
    objects, // an object of named objects with these keys
    array    // an array of objects with these keys
};

struct SceneSection {
    std::string_view name;
    SectionForm form;
    std::string_view words;
    std::span<const SceneKey> keys;

    bool may_be_many() const; // whether an item may be, by columns

    // Whether values may change from frame to frame: those of the camera, of materials and of surfaces.
    bool may_move() const { return form != SectionForm::members || name == "camera"; }
};

// All but `animation`, whose keys are paths.
std::span<const SceneSection> scene_sections();

const SceneSection *find_section(std::string_view name); // nullptr: there is none
const SceneKey *find_key(const SceneSection &section, std::string_view name);

std::vector<std::string_view> key_names(const SceneSection &section);

// Of a text without byte order mark. Throws JsonRefusal, or Failure for an override of the scene that does not fit or
// whose value is refused.
void read_sections(SceneFile &scene, std::string_view text);

} // namespace cli
