// The simulation box as lines.
#pragma once

#include "cli/data/particles.h"
#include "cli/figure/overlay.h"

#include <array>

namespace cli {

std::array<glm::dvec3, 8> corners_of(const SimulationBox &box);
std::array<Segment, 12> edges_of(const SimulationBox &box);

} // namespace cli
