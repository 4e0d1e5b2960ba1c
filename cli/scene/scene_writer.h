// Writes a scene for other programs that use the library, so that scene files have one reader.
#pragma once

#include "cli/scene/scene_file.h"

#include <iosfwd>

namespace cli {

// Writes a line of JSON with the fields of pt.h by name (camera, render, materials, spheres, planes, sphere_arrays) and
// the files of columns. A sphere array's column has a type and a number of rows, 1 for all spheres; the numbers follow
// the line as bytes, in that order.
void write_scene(std::ostream &stream, const SceneFile &file, const pt_render &render);

} // namespace cli
