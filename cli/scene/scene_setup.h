// Hands scene, camera and settings to the library, and explains what it refuses in the words of whoever gave the value.
#pragma once

#include "cli/base/context.h"
#include "cli/scene/render_settings.h"
#include "cli/scene/scene_file.h"

#include <functional>

namespace cli {

// All throw Failure. A rule that the scene file breaks is explained by its keys and lines, and is its fault
// (ExitCode::scene), also where the library finds it only when it is to take samples.
//
// Scene and camera. goes_on is told the share of the scene that is taken over, and may end that by returning false:
// then false is returned, and the context is as it was.
bool describe_scene(const Context &context, const SceneFile &file, const std::function<bool(double)> &goes_on);

// Of pt_set_render and pt_accumulate.
void require_render(const Context &context, const SceneFile &file, const RenderSettings &settings, pt_result result);

// Scene, camera and render settings.
void describe(const Context &context, const SceneFile &file, const RenderSettings &settings);

} // namespace cli
