// Lamps in the place of lights that have no size.
#pragma once

#include "cli/import/foreign_scene.h"

#include <vector>

namespace cli {

// A ball, and the radiance of its surface.
struct ForeignLamp {
    ForeignVector center;
    double radius;
    ForeignVector emission;
};

// What lights a white diffuse surface at the point that the camera looks at, if it faces the lamp, as the light would.
// At the distance d from that point a lamp has the radius d / 50, or less where surfaces or the camera are near: half
// of the distance to them. Lights with a direction are put at a hundred times the size of the scene. Lights of no
// colour, and those on a surface, for which there is a warning, have no lamp.
std::vector<ForeignLamp> lamps_of(const ForeignScene &scene, std::vector<std::string> &left_out);

// The largest distance from that point to anything that the scene has but planes; above 0.
double extent_of(const ForeignScene &scene);

} // namespace cli
