// The section `animation` of a scene file: values that change from frame to frame.
#pragma once

#include "cli/base/json_path.h"

#include <cstdint>
#include <string>
#include <vector>

namespace cli {

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

} // namespace cli
