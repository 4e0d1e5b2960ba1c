// A figure as a scene file: what `pt figure` renders, and `pt render` too.
#pragma once

#include "cli/base/number.h"
#include "cli/figure/stage.h"

#include <nlohmann/json_fwd.hpp>

#include <cstdint>

namespace cli {

// The names of materials in it.
inline constexpr const char *particle_material = "particles";

struct FigureSettings {
    ImageSize size;
    std::uint32_t sample_count;
};

// All of the scene but the particles.
nlohmann::ordered_json figure_scene(const FittedCamera &camera, const Stage &stage, const FigureSettings &settings);

} // namespace cli
