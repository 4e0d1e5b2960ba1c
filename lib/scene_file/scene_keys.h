// The table of scene keys, from which reader, JSON Schema, options and the manual's rows are made.
#pragma once

#include "lib/scene_file/json_value.h"
#include "lib/scene_file/scene_file.h"

#include <pt/pt.h>

#include <array>
#include <span>
#include <string>
#include <string_view>

namespace pt {

struct SceneItem {
    SceneFile &scene;
    pt_material material{};
    SphereItem sphere{};
    pt_plane plane{};
    std::string material_name{};
};

struct SceneKey {
    std::string_view name;
    ValueRule rule;
    std::string_view words;
    std::string_view initial; // default in the file's notation, or empty
    bool is_required;
    void (*store)(SceneItem &item, const nlohmann::json &value); // `value` obeys the rule
    std::string_view option = {};
    pt_column pt_sphere_array::*column = nullptr; // nullptr if the key cannot be a column
};

enum class SectionForm {
    members,
    objects, // named objects that have these keys
    array    // objects that have these keys
};

struct SceneSection {
    std::string_view name;
    SectionForm form;
    std::string_view words;
    std::span<const SceneKey> keys;

    bool may_be_many() const;

    bool may_move() const { return form != SectionForm::members || name == "camera"; }
};

// All sections except `animation`, whose keys are paths.
std::span<const SceneSection> scene_sections();

const SceneSection *find_section(std::string_view name);
const SceneKey *find_key(const SceneSection &section, std::string_view name);

std::vector<std::string_view> key_names(const SceneSection &section);

// `text` must have no byte order mark. Also throws JsonRefusal.
void read_sections(SceneFile &scene, std::string_view text);

} // namespace pt
