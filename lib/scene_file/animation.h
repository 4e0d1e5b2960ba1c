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

    // `time` is in frames. Values are linear between key frames and constant outside.
    std::vector<double> at(double time) const;
};

// Throws JsonRefusal.
AnimatedValue read_animated_value(const JsonPlace &place, const nlohmann::json &value);

// Frame n lasts from time n to n + 1. Shutter times are fractions of a frame. Spheres move straight during a frame. All
// other values are taken at the middle of the shutter's time.
std::vector<SceneOverride> overrides_of_frame(const SceneFile &scene, std::uint32_t frame);

// Returns the file with the values of a frame; the file's own overrides are applied afterwards. Adds the frame's number
// to the seed, because equal noise in all frames would look like a fixed pattern. Throws PT_ERROR_INVALID_SCENE, also
// if there is no animation.
SceneFile scene_in_frame(const SceneFile &scene, std::uint32_t frame);

} // namespace pt
