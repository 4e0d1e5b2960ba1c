// A figure as a scene: what `pt figure` renders, and `pt render` too.
#pragma once

#include "cli/layout/figure_layout.h"
#include "cli/scene/scene_file.h"

#include <nlohmann/json_fwd.hpp>

#include <cstdint>
#include <optional>
#include <string>

namespace cli {

// Of all particles of a scene.
Balls balls_of(const SceneFile &scene);

// What stands around the particles, without them. name: what messages call it.
SceneFile stage_scene(const FigureLayout &layout, const std::string &name);

// Gives a scene the camera and the light, and its particles without a material that of the figure. The size, the
// exposure and the length of paths are what the scene does not say otherwise.
void furnish(SceneFile &scene, const FigureLayout &layout);

// A scene file of the same, which names the file of the particles and gives every bit of the numbers back.
std::string figure_scene_text(const FigureLayout &layout, std::uint32_t sample_count, const ParticleEntry &particles);

} // namespace cli
