// Options that replace a scene file's values.
#pragma once

#include "lib/scene_file/scene_override.h"

#include <vector>

namespace CLI {
class App;
}

namespace cli {

using pt::SceneOverride;

// The option --set, which fills `overrides`.
void add_set(CLI::App &command, std::vector<SceneOverride> &overrides);

// Parsing fills `overrides`. has_scene: false leaves only the display's options.
void add_scene_options(CLI::App &command, std::vector<SceneOverride> &overrides, bool has_scene);

} // namespace cli
