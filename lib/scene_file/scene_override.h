// A value of an option or an animation that replaces one in a scene file.
#pragma once

#include "lib/base/error.h"
#include "lib/scene_file/json_value.h"

#include <nlohmann/json.hpp>

#include <cstddef>
#include <string>

namespace pt {

inline constexpr std::size_t item_depth = 2;

struct SceneOverride {
    JsonPath path;
    nlohmann::json value;
    std::string source; // for messages, such as "--set camera.vertical_fov=30"
    pt_result blame;
    bool is_its_name = false; // messages name the value by `source`, not by its path

    // Adds missing members of objects. Elements of arrays must exist. Throws `blame`.
    void apply_to(nlohmann::json &item) const;

    std::string name_of(const JsonPath &part) const { return is_its_name ? source : source + ": " + path_text(part); }
};

// `text` is for example "camera.vertical_fov=30". A value that is not JSON is a text, so names need no quotes. Messages
// have `name`, such as "--set ", before the text. Throws PT_ERROR_INVALID_ARGUMENT.
SceneOverride parse_override(const std::string &text, const std::string &name);

} // namespace pt
