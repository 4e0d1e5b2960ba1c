// Overrides of a scene file's values: by --set, by options that equal a key, and by an animation, whose values change
// between frames.
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

inline constexpr std::size_t item_depth = 2; // steps from the root to an item of a section

struct SceneOverride {
    JsonPath path; // within a section
    nlohmann::json value;
    std::string source;       // for messages: "--set camera.vertical_fov=30", "--spp"
    ExitCode blame;           // exit code if the source is wrong
    bool is_its_name = false; // whether messages call the value by its source: "--spp"

    // Puts the value into a section's item. Adds members that an object lacks; elements of arrays must exist. Throws
    // Failure.
    void apply_to(nlohmann::json &item) const;

    // The value's name in messages.
    std::string name_of(const JsonPath &part) const { return is_its_name ? source : source + ": " + path_text(part); }
};

// Parses "camera.vertical_fov=30". The value is JSON, or else a text, so that names need no quotes. Throws
// Failure(ExitCode::usage).
SceneOverride parse_override(const std::string &text);

// Parsing writes into `overrides`. has_scene: false for commands without a scene file, which have only the options of
// the display.
void add_scene_options(CLI::App &command, std::vector<SceneOverride> &overrides, bool has_scene);

struct SceneFile;

struct KeyFrame {
    std::uint32_t frame;
    std::vector<double> numbers; // equally many in all key frames
};

struct AnimatedValue {
    std::string name; // as in the file: "spheres[0].center"
    JsonPath path;
    bool is_array;              // false: a single number
    std::vector<KeyFrame> keys; // by frame; at least one

    // time: in frames. Linear between key frames, constant before the first and after the last.
    std::vector<double> at(double time) const;
};

// Throws JsonRefusal.
AnimatedValue read_animated_value(const JsonPlace &place, const nlohmann::json &value);

// The overrides of a frame, which lasts from its number to the next one; the shutter's times are shares of it. Spheres
// move on a straight way from their place at its beginning to their place at its end. All else stands still, as in the
// middle of the shutter's time.
std::vector<SceneOverride> overrides_of_frame(const SceneFile &scene, std::uint32_t frame);

} // namespace cli
