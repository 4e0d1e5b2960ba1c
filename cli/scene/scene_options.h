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

// Parsing fills `overrides`. Without has_scene only the display's options are added.
void add_scene_options(CLI::App &command, std::vector<SceneOverride> &overrides, bool has_scene);

} // namespace cli
