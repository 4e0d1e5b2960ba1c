#include "cli/scene/scene_setup.h"

#include "cli/base/exit_code.h"

namespace cli {
namespace {

// A rule that is broken here is the scene file's.
void require_scene(const Context &context, const SceneFile &file, pt_result result) {
    if (result < 0) {
        const LibraryError error = context.last_error();
        throw Failure(error.rules.empty() ? exit_code_of(result) : ExitCode::scene, file.explain(error));
    }
}

} // namespace

void require_render(const Context &context, const SceneFile &file, const RenderSettings &settings, pt_result result) {
    const LibraryError error = result < 0 ? context.last_error() : LibraryError{};
    if (!error.rules.empty()) {
        throw settings.explain(error, file);
    }
    context.require(result);
}

void describe_scene(const Context &context, const SceneFile &file) {
    const pt_scene scene = file.scene();
    require_scene(context, file, pt_set_scene(context.get(), &scene));
    require_scene(context, file, pt_set_camera(context.get(), &file.camera));
}

void describe(const Context &context, const SceneFile &file, const RenderSettings &settings) {
    describe_scene(context, file);
    require_render(context, file, settings, pt_set_render(context.get(), &settings.render));
}

} // namespace cli
