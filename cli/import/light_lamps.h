// Lamps in the place of lights, which are points or directions.
#pragma once

#include "cli/import/foreign_scene.h"

#include <string>
#include <vector>

namespace cli {

// A ball, and the radiance of its surface.
struct ForeignLamp {
    ForeignVector center;
    double radius;
    ForeignVector emission;
    bool is_hidden; // from the camera
};

// What lights a white diffuse surface at the point that the camera looks at, if it faces the lamp, as the light would.
// A light without a radius of its own gets a 50th of its distance from that point, and is hidden from the camera. Where
// surfaces are near, or the camera that sees it, a lamp has half of the distance to them, if that is less. Lights with
// a direction are put at a hundred times the size of the scene. Lights that are black have no lamp, nor have those on a
// surface, for which there is a warning.
std::vector<ForeignLamp> lamps_of(const ForeignScene &scene, std::vector<std::string> &left_out);

// The largest distance from that point to anything that the scene has but planes; above 0.
double extent_of(const ForeignScene &scene);

} // namespace cli
