#include "cli/scene/scene.h"

#include "cli/base/file.h"
#include "lib/tree/tree_choice.h"

#include <algorithm>

namespace cli {
namespace {

bool is_of_command(const SceneFile &scene, const BrokenRule &rule) {
    return find_option(rule) != nullptr && !scene.gives(rule);
}

std::string read_standard_input() {
    const auto read = [] { return platform::InputFile().text(); };
    return with_exit_code([&] { return pt::read_named("standard input", read); });
}

// Blames the scene even if the message names no field.
void require_scene(const Context &context, const SceneFile &scene, pt_result result) {
    if (result < 0) {
        const LibraryError error = context.last_error();
        throw Failure(error.rules.empty() ? exit_code_of(result) : blame(scene, error), explain(scene, error));
    }
}

} // namespace

SceneFile parse_scene(std::string text, const std::string &path, std::vector<SceneOverride> overrides) {
    return with_exit_code([&] { return pt::scene_of_text(std::move(text), path, std::move(overrides)); });
}

SceneFile read_scene_file(const std::string &path, std::vector<SceneOverride> overrides) {
    if (path == standard_stream)
        return parse_scene(read_standard_input(), "standard input", std::move(overrides));
    return with_exit_code([&] { return pt::scene_of_file(path, std::move(overrides)); });
}

void load_columns(SceneFile &scene) {
    with_exit_code([&] { pt::read_columns(scene); });
}

bool gets_tree(const SceneFile &scene) {
    const pt::SphereCounts counts = pt::count_spheres(scene.scene().sphere_count, scene.sphere_arrays());
    return counts.spheres >= pt::tree_from(counts);
}

pt_display_info display_of(const std::vector<SceneOverride> &overrides) {
    return parse_scene("{}", "", overrides).display;
}

std::string explain(const SceneFile &scene, const BrokenRule &rule) {
    return is_of_command(scene, rule) ? in_words_of_options(rule) : scene.explain(rule);
}

std::string explain(const SceneFile &scene, const LibraryError &error) {
    return error.rules.empty() ? scene.path + ": " + error.message
                               : error.in_words([&](const BrokenRule &rule) { return explain(scene, rule); });
}

ExitCode blame(const SceneFile &scene, const BrokenRule &rule) {
    return is_of_command(scene, rule) ? ExitCode::usage : exit_code_of(scene.blame(rule));
}

ExitCode blame(const SceneFile &scene, const LibraryError &error) {
    const bool is_usage =
        std::ranges::any_of(error.rules, [&](const BrokenRule &rule) { return blame(scene, rule) == ExitCode::usage; });
    return is_usage ? ExitCode::usage : ExitCode::scene;
}

bool describe_scene(const Context &context, const SceneFile &file, const std::function<bool(double)> &goes_on) {
    std::function<bool(double)> listener = goes_on; // copied, because pt_scene.progress_user is not const
    pt_scene scene = file.scene();
    const std::vector<pt_sphere_array> arrays = file.sphere_arrays();
    scene.sphere_arrays = arrays.data();
    scene.sphere_array_count = static_cast<std::uint32_t>(arrays.size());
    scene.progress = &call_listener;
    scene.progress_user = &listener;
    const pt_result result = pt_set_scene(context.get(), &scene);
    require_scene(context, file, result);
    if (result == PT_CANCELLED)
        return false;
    require_scene(context, file, pt_set_camera(context.get(), &file.camera));
    return true;
}

} // namespace cli
