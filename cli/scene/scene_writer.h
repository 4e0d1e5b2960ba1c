// Writes a scene for other programs, so that only `pt` reads scene files.
#pragma once

#include "cli/scene/scene.h"

#include <iosfwd>

namespace cli {

// Writes a line of JSON with the fields of pt.h, then the bytes of all columns in its order. A column has a type and a
// number of rows, 1 for all spheres.
void write_scene(std::ostream &stream, const SceneFile &file, const pt_render &render);

} // namespace cli
