// Scenes of Tachyon (jedi.ks.uiuc.edu/~johns/raytracer), of which spheres and planes are read: VMD and OVITO write
// such.
#pragma once

#include "cli/import/foreign_scene.h"

#include <string>
#include <string_view>

namespace cli {

// Throws Failure(ExitCode::scene) with file and line. Tachyon's axes are left-handed: here z has the other sign.
ForeignScene read_tachyon(std::string_view text, const std::string &path);

} // namespace cli
