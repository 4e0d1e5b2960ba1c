// A figure as a scene file: what `pt figure` renders, and `pt render` too.
#pragma once

#include "cli/figure/figure_layout.h"
#include "cli/figure/figure_particles.h"
#include "cli/scene/scene_file.h"

#include <nlohmann/json_fwd.hpp>

#include <cstdint>
#include <string>

namespace cli {

// The scene without its particles, as text and as the program reads it. name: what messages call it.
nlohmann::ordered_json stage_json(const FigureLayout &layout, std::uint32_t sample_count);
SceneFile stage_scene(const FigureLayout &layout, std::uint32_t sample_count, const std::string &name);

// With the particles: a material for each colour, and spheres behind those of the stage.
SceneFile figure_scene(const SceneFile &stage, const Stage &look, const FigureParticles &particles);

// A scene file that gives every bit of the numbers back.
std::string figure_scene_text(const FigureLayout &layout, std::uint32_t sample_count, const FigureParticles &particles);

} // namespace cli
