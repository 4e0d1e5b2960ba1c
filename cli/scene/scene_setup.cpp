#include "cli/scene/scene_setup.h"

#include "cli/base/exit_code.h"

#include <vector>

namespace cli {
namespace {

// A rule that is broken here is the scene file's.
void require_scene(const Context &context, const SceneFile &file, pt_result result) {
    if (result < 0) {
        const LibraryError error = context.last_error();
        throw Failure(error.rules.empty() ? exit_code_of(result) : file.blame(error.rules.front()),
                      file.explain(error));
    }
}

// What the library's progress callback needs.
std::int32_t receive_share(void *user, double share) {
    return (*static_cast<const std::function<bool(double)> *>(user))(share) ? 0 : 1;
}

} // namespace

void require_render(const Context &context, const SceneFile &file, const RenderSettings &settings, pt_result result) {
    const LibraryError error = result < 0 ? context.last_error() : LibraryError{};
    if (!error.rules.empty())
        throw settings.explain(error, file);
    context.require(result);
}

bool describe_scene(const Context &context, const SceneFile &file, const std::function<bool(double)> &goes_on) {
    std::function<bool(double)> listener = goes_on; // the library's pointer is to what may change
    pt_scene scene = file.scene();
    const std::vector<pt_sphere_array> arrays = file.sphere_arrays();
    scene.sphere_arrays = arrays.data();
    scene.sphere_array_count = static_cast<std::uint32_t>(arrays.size());
    const std::vector<std::uint32_t> flags = file.material_flags();
    scene.material_flags = flags.empty() ? nullptr : flags.data();
    scene.progress = &receive_share;
    scene.progress_user = &listener;
    const pt_result result = pt_set_scene(context.get(), &scene);
    require_scene(context, file, result);
    if (result == PT_CANCELLED)
        return false;
    require_scene(context, file, pt_set_camera(context.get(), &file.camera));
    return true;
}

void describe(const Context &context, const SceneFile &file, const RenderSettings &settings) {
    describe_scene(context, file, [](double) { return true; });
    require_render(context, file, settings, pt_set_render(context.get(), &settings.render));
}

} // namespace cli
