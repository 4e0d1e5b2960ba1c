#pragma once

#include "cli/base/context.h"
#include "cli/base/exit_code.h"
#include "lib/scene_file/scene_file.h"

#include <string>
#include <utility>
#include <vector>

namespace cli {

using pt::SceneFile;
using pt::SceneOverride;

template <typename Call>
auto with_exit_code(const Call &call) {
    try {
        return call();
    } catch (const pt::Error &error) {
        throw Failure(exit_code_of(error.code()), error.what());
    }
}

SceneFile parse_scene(std::string text, const std::string &path, std::vector<SceneOverride> overrides = {});

// `path` may be "-" for standard input.
SceneFile read_scene_file(const std::string &path, std::vector<SceneOverride> overrides = {});

void load_columns(SceneFile &scene);

pt_display_info display_of(const std::vector<SceneOverride> &overrides);

// Names the option that sets the field, unless the scene sets the field.
std::string explain(const SceneFile &scene, const BrokenRule &rule);
std::string explain(const SceneFile &scene, const LibraryError &error);

// ExitCode::scene, or ExitCode::usage for the value of an option.
ExitCode blame(const SceneFile &scene, const BrokenRule &rule);
ExitCode blame(const SceneFile &scene, const LibraryError &error);

} // namespace cli
