// A scene of another program as the items of a scene file.
#pragma once

#include "cli/import/foreign_scene.h"
#include "cli/scene/json_sections.h"

namespace cli {

// Spheres have the numbers that they have in their file; lamps and the sky, a ball around all, come after them.
void hand_on(ForeignScene &scene, JsonSectionHandler &handler);

} // namespace cli
