// The section `particles` of a scene file: files whose particles are spheres of the scene.
#pragma once

#include "cli/base/json_value.h"
#include "cli/scene/particle_entry.h"

#include <string>
#include <vector>

namespace cli {

struct SceneFile;

// All but the material. Throws JsonRefusal.
ParticleEntry read_particle_entry(const JsonPlace &place, const nlohmann::json &value);

// Reads the files. Throws Failure.
void load_particles(SceneFile &scene);

// What the colours of particles show where no range is given: tells the ranges on stderr.
void tell_chosen_ranges(const SceneFile &scene);

// Where the files are, one an entry.
std::vector<std::string> particle_paths(const SceneFile &scene);

} // namespace cli
