#include "cli/scene/scene_setup.h"

#include "cli/base/exit_code.h"

namespace cli {
namespace {

// What the library refuses here came from the scene file.
void require_scene(const Context &context, const SceneFile &file, pt_result result) {
    if (result < 0) {
        const ExitCode code = result == PT_ERROR_INVALID_ARGUMENT ? ExitCode::scene : exit_code_of(result);
        throw Failure(code, file.explain(context.last_error()));
    }
}

} // namespace

void require_render(const Context &context, const SceneFile &file, const RenderSettings &settings, pt_result result) {
    if (result == PT_ERROR_INVALID_ARGUMENT || result == PT_ERROR_UNSUPPORTED) {
        throw settings.explain(context.last_error(), file);
    }
    context.require(result);
}

void require_samples(const Context &context, const SceneFile &file, const RenderSettings &settings, pt_result result) {
    const LibraryError error = result < 0 ? context.last_error() : LibraryError{};
    if (!error.rules.empty()) {
        throw Failure(exit_code_of(result), settings.explain(error, file).what());
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
