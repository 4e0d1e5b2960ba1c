// Reads the section `animation` of a scene file, and makes the scene of a frame of it.
#pragma once

#include "cli/base/json_value.h"
#include "cli/scene/scene_file.h"
#include "cli/scene/scene_override.h"

#include <cstdint>
#include <vector>

namespace cli {

// Of one value; throws JsonRefusal.
void read_animation_item(SceneFile &scene, const JsonPlace &place, const nlohmann::json &value);

// What takes the place of the scene's values in a frame. A frame lasts from its number to the next one, and the
// shutter's times are shares of that: spheres move within the frame, on a straight way from where they are at its begin
// to where they are at its end; all else stands still, as it is in the middle of the time that the shutter is open.
std::vector<SceneOverride> overrides_of_frame(const SceneFile &scene, std::uint32_t frame);

} // namespace cli
