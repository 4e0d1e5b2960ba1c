// A scene file's key frames.
#pragma once

#include "lib/scene_file/scene_override.h"

#include <nlohmann/json.hpp>

#include <cstdint>
#include <string>
#include <vector>

namespace pt {

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

    // `time` is in frames. Linear between key frames, constant outside.
    std::vector<double> at(double time) const;
};

// Throws JsonRefusal.
AnimatedValue read_animated_value(const JsonPlace &place, const nlohmann::json &value);

// A frame lasts from its number to the next. Shutter times are fractions of it. Spheres move straight during a frame.
// Everything else stands still as in the middle of the shutter's time.
std::vector<SceneOverride> overrides_of_frame(const SceneFile &scene, std::uint32_t frame);

// Returns the file with the values of a frame, before the file's own overrides. Adds the frame's number to the seed,
// because equal noise in all frames would look like a fixed pattern. Throws PT_ERROR_INVALID_SCENE, also without an
// animation.
SceneFile scene_in_frame(const SceneFile &scene, std::uint32_t frame);

} // namespace pt
