// The section `animation` of a scene file: values that change from frame to frame.
#pragma once

#include "cli/base/json_path.h"
#include "cli/scene/scene_override.h"

#include <nlohmann/json.hpp>

#include <cstdint>
#include <string>
#include <vector>

namespace cli {

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

// Of one value; throws JsonRefusal.
void read_animation_item(SceneFile &scene, const JsonPlace &place, const nlohmann::json &value);

// What takes the place of the scene's values in a frame. A frame lasts from its number to the next one, and the
// shutter's times are shares of that: spheres move within the frame, on a straight way from where they are at its begin
// to where they are at its end; all else stands still, as it is in the middle of the time that the shutter is open.
std::vector<SceneOverride> overrides_of_frame(const SceneFile &scene, std::uint32_t frame);

} // namespace cli
