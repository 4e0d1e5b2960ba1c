// What stands around the particles of a figure: soft light, and a floor where one is wanted. All is sized by the data,
// so that angstroms and light years look alike.
#pragma once

#include "cli/layout/camera_fit.h"

#include <array>
#include <optional>
#include <string_view>

namespace cli {

enum class FigureStyle { matte, glossy, ambient_occlusion };

inline constexpr std::array<std::string_view, 3> figure_style_names{"matte", "glossy", "ambient-occlusion"};

std::optional<FigureStyle> find_figure_style(std::string_view name);

struct StageLamp {
    glm::dvec3 center;
    double radius;
    double emission; // radiance, of all channels
};

struct Floor {
    glm::dvec3 normal; // unit, upwards
    double height;     // along the normal
};

struct Stage {
    // A sphere around everything, which shines evenly. Where all of it is seen, a surface of albedo 1 is as bright as
    // it; in clefts it is darker.
    StageLamp surround;
    std::optional<StageLamp> key; // a large lamp far behind the left shoulder of the camera, for the shape of bodies
    std::optional<Floor> floor;
    double floor_albedo;
    double diffuse; // of the particles, which their colours multiply
    double specular;
    double glossiness;
    unsigned max_path_length;
};

// A ball around all that is seen.
struct Bounds {
    glm::dvec3 center;
    double radius;
};

// Light falls from where the camera is, and from above in the picture. floor: none, if there is to be none.
Stage make_stage(FigureStyle style, const FittedCamera &camera, const Bounds &bounds,
                 const std::optional<Floor> &floor);

} // namespace cli
