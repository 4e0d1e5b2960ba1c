#pragma once

#include "cli/base/context.h"
#include "cli/base/exit_code.h"
#include "lib/scene_file/scene_file.h"

#include <functional>
#include <string>
#include <vector>

namespace cli {

using pt::SceneFile;
using pt::SceneOverride;

SceneFile parse_scene(std::string text, const std::string &path, std::vector<SceneOverride> overrides = {});

// `path` may be "-" for standard input.
SceneFile read_scene_file(const std::string &path, std::vector<SceneOverride> overrides = {});

void load_columns(SceneFile &scene);

// Counts hidden spheres, too.
bool gets_tree(const SceneFile &scene);

pt_display_info display_of(const std::vector<SceneOverride> &overrides);

// Names the option that sets the field, unless the scene sets the field.
std::string explain(const SceneFile &scene, const BrokenRule &rule);
std::string explain(const SceneFile &scene, const LibraryError &error);

// ExitCode::scene, or ExitCode::usage for the value of an option.
ExitCode blame(const SceneFile &scene, const BrokenRule &rule);
ExitCode blame(const SceneFile &scene, const LibraryError &error);

// Sets scene and camera. If goes_on(share) returns false, returns false with an unchanged context. Throws Failure.
bool describe_scene(const Context &context, const SceneFile &file, const std::function<bool(double)> &goes_on);

} // namespace cli
