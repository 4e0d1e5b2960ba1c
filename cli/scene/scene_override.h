// Values that take the place of a scene file's, or are added to it: of --set, of options that say the same as a key,
// and of the frames of an animation.
#pragma once

#include "cli/base/exit_code.h"
#include "cli/base/json_path.h"

#include <nlohmann/json.hpp>

#include <cstddef>
#include <string>
#include <vector>

namespace CLI {
class App;
}

namespace cli {

inline constexpr std::size_t item_depth = 2; // steps from the root to an item of a section

struct SceneOverride {
    JsonPath path; // of a value within a section
    nlohmann::json value;
    std::string source;       // for messages: "--set camera.vertical_fov=30", "--spp"
    ExitCode blame;           // where the source is wrong
    bool is_its_name = false; // whether the source is what the value is called: "--spp"

    // Puts the value into an item of a section. Members that an object lacks are added; elements of arrays have to be
    // there. Throws Failure.
    void apply_to(nlohmann::json &item) const;

    // What it is called in messages.
    std::string name_of(const JsonPath &part) const { return is_its_name ? source : source + ": " + path_text(part); }
};

// "camera.vertical_fov=30". The value is JSON; what is none is a text, so that names need no quotes. Throws
// Failure(ExitCode::usage).
SceneOverride parse_override(const std::string &text);

// The options write into `overrides` when the command line is parsed. has_scene: whether there is a scene file, as of
// `pt render`; otherwise there are only those that say how a picture is shown.
void add_scene_options(CLI::App &command, std::vector<SceneOverride> &overrides, bool has_scene);

} // namespace cli
