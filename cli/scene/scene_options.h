// The options that give values in place of a scene's: --set, and those that say the same as a key of the table.
#pragma once

#include "cli/scene/scene_override.h"

#include <vector>

namespace CLI {
class App;
}

namespace cli {

// The options write into `overrides` when the command line is parsed. has_scene: whether there is a scene file, as of
// `pt render`; otherwise there are only those that say how a picture is shown.
void add_scene_options(CLI::App &command, std::vector<SceneOverride> &overrides, bool has_scene);

} // namespace cli
