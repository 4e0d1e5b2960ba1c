// Values that take the place of a scene file's, or are added to it: of --set, of options that say the same as a key,
// and of the frames of an animation, whose section has values that change from frame to frame.
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

struct SceneFile;

struct KeyFrame {
    std::uint32_t frame;
    std::vector<double> numbers; // equally many in all key frames of a value
};

struct AnimatedValue {
    std::string name; // as in the file: "spheres[0].center"
    JsonPath path;
    bool is_array;              // otherwise a single number
    std::vector<KeyFrame> keys; // by frame; at least one

    // At a time in frames: on straight lines between key frames, and constant before the first and after the last.
    std::vector<double> at(double time) const;
};

// Throws JsonRefusal.
AnimatedValue read_animated_value(const JsonPlace &place, const nlohmann::json &value);

// What takes the place of the scene's values in a frame. A frame lasts from its number to the next one, and the
// shutter's times are shares of that: spheres move within the frame, on a straight way from where they are at its begin
// to where they are at its end; all else stands still, as it is in the middle of the time that the shutter is open.
std::vector<SceneOverride> overrides_of_frame(const SceneFile &scene, std::uint32_t frame);

} // namespace cli
