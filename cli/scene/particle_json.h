// An entry of the section `particles` of a scene file, written.
#pragma once

#include "cli/scene/particle_entry.h"

#include <nlohmann/json_fwd.hpp>

namespace cli {

// Of one that is loaded, but for its material. What was chosen by default, radius and range, is given as numbers: the
// camera of the scene is made for these.
nlohmann::ordered_json particle_json(const ParticleEntry &entry);

} // namespace cli
