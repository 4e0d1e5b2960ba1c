// Owns the handing over of scene, camera and settings to the library, and who is to blame for what it refuses.
// Called by render_command and bench_command.
#pragma once

#include "cli/base/context.h"
#include "cli/scene/render_settings.h"
#include "cli/scene/scene_file.h"

namespace cli {

// All throw Failure: a rule that the scene file breaks is explained in the file's words.
void describe_scene(const Context &context, const SceneFile &file); // and camera
void require_render(const Context &context, const SceneFile &file, const RenderSettings &settings, pt_result result);
void require_samples(const Context &context, const SceneFile &file, const RenderSettings &settings, pt_result result);

// Scene, camera and render settings.
void describe(const Context &context, const SceneFile &file, const RenderSettings &settings);

} // namespace cli
