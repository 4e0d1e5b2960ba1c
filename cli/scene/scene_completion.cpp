#include "cli/scene/scene_completion.h"

#include "cli/layout/figure_layout.h"
#include "cli/scene/figure_scene.h"
#include "cli/scene/render_settings.h"

#include <stdexcept>

namespace cli {
namespace {

// A side that is given makes the other its default, as in every scene.
std::optional<ImageSize> size_of(const SceneFile &scene) {
    if (!scene.width && !scene.height) {
        return std::nullopt;
    }
    return ImageSize{scene.width.value_or(default_side), scene.height.value_or(default_side)};
}

FigureLayout layout_of(const SceneFile &scene, const std::optional<ImageSize> &size) {
    const Balls balls = balls_of(scene);
    if (balls.count() == 0) {
        throw Failure(ExitCode::scene, scene.path + ": figure: its particles are none");
    }
    try {
        return lay_out(*scene.figure, size ? size : size_of(scene), balls, std::nullopt);
    } catch (const std::invalid_argument &error) {
        throw Failure(ExitCode::scene, scene.path + ": figure.floor: " + error.what());
    }
}

} // namespace

void complete_scene(SceneFile &scene, const std::optional<ImageSize> &size) {
    load_particles(scene);
    if (scene.figure) {
        furnish(scene, layout_of(scene, size));
    }
}

SceneFile read_scene_file(const std::string &path, const std::optional<ImageSize> &size) {
    const SceneText scene = read_scene_text(path);
    SceneFile file = parse_scene(scene.text, scene.path);
    complete_scene(file, size);
    return file;
}

} // namespace cli
