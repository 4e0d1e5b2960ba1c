// Values that replace a scene file's: by --set, by options, and by animation.
#pragma once

#include "cli/base/exit_code.h"
#include "cli/base/json.h"

#include <nlohmann/json.hpp>

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

namespace CLI {
class App;
}

namespace cli {

inline constexpr std::size_t item_depth = 2;

struct SceneOverride {
    JsonPath path;
    nlohmann::json value;
    std::string source;       // shown in messages: "--set camera.vertical_fov=30"
    ExitCode blame;           // if the value is wrong
    bool is_its_name = false; // messages call the value "--spp", not by its path

    // Adds missing members of objects; elements of arrays must exist. Throws Failure.
    void apply_to(nlohmann::json &item) const;

    std::string name_of(const JsonPath &part) const { return is_its_name ? source : source + ": " + path_text(part); }
};

// "camera.vertical_fov=30": JSON, or else a text, so names need no quotes. Throws Failure(ExitCode::usage).
SceneOverride parse_override(const std::string &text);

// The option --set, which fills `overrides`.
void add_set(CLI::App &command, std::vector<SceneOverride> &overrides);

// Parsing fills `overrides`. has_scene: false leaves only the display's options.
void add_scene_options(CLI::App &command, std::vector<SceneOverride> &overrides, bool has_scene);

struct SceneFile;

struct KeyFrame {
    std::uint32_t frame;
    std::vector<double> numbers;
};

struct AnimatedValue {
    std::string name; // "spheres[0].center"
    JsonPath path;
    bool is_array;
    std::vector<KeyFrame> keys; // ascending; at least one

    // time: in frames. Linear between key frames, constant outside.
    std::vector<double> at(double time) const;
};

// Throws JsonRefusal.
AnimatedValue read_animated_value(const JsonPlace &place, const nlohmann::json &value);

// A frame lasts from its number to the next; shutter times are shares of it. Spheres move straight during a frame; all
// else stands still as in the middle of the shutter's time.
std::vector<SceneOverride> overrides_of_frame(const SceneFile &scene, std::uint32_t frame);

} // namespace cli
