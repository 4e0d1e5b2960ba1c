// Makes a scene of what a scene file says and of the files that it names.
#pragma once

#include "cli/base/number.h"
#include "cli/scene/scene_file.h"

#include <optional>
#include <string>

namespace cli {

// Reads the files of particles; for a figure adds camera, lamps, floor and the size of the picture. size: of the
// picture, where it is not the scene's to say. Throws Failure.
void complete_scene(SceneFile &scene, const std::optional<ImageSize> &size);

// The path - is standard input. Throws Failure: ExitCode::file if the file cannot be read, ExitCode::scene if it is not
// a scene file.
SceneFile read_scene_file(const std::string &path, const std::optional<ImageSize> &size = std::nullopt);

} // namespace cli
