// A scene for another program that uses the library itself, so that there is one reader of scene files.
#pragma once

#include "cli/scene/scene_file.h"

#include <iosfwd>

namespace cli {

// Writes one line of JSON with the fields of pt.h by their names (camera, render, materials, spheres, planes,
// sphere_arrays), and the files with columns. For each column of a sphere array it has the type and the number of rows,
// of which 1 is for all spheres; their numbers follow the line as bytes, in that order.
void write_scene(std::ostream &stream, const SceneFile &file, const pt_render &render);

} // namespace cli
