// Where a value stands in a scene file: "scene.json:12: spheres[3].radius".
#pragma once

#include "cli/base/json_path.h"
#include "cli/base/library_error.h"
#include "cli/scene/scene_file.h"

#include <cstddef>
#include <optional>
#include <string>

namespace cli {

// In words, without what is not known: the line, or the path if it is empty.
std::string place_text(const std::string &file, std::optional<std::size_t> line, const std::string &path);

// Of the field that breaks a rule; empty if it is none of the file's.
JsonPath path_of(const SceneFile &scene, const BrokenRule &rule);

} // namespace cli
