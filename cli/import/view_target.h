// What a camera that has a direction looks at.
#pragma once

#include "cli/import/foreign_scene.h"

namespace cli {

// Of the points that the middle of the picture shows, the one nearest to the middle of the box around all spheres; in
// front of the camera. Without spheres there, where the nearest plane is met, else the one at the distance 1.
ForeignVector view_target(const ForeignScene &scene, const ForeignVector &position, const ForeignVector &direction);

} // namespace cli
