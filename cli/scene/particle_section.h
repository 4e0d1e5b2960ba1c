// The section `particles` of a scene file: files whose particles are spheres of the scene.
#pragma once

#include "cli/base/json_value.h"
#include "cli/scene/particle_entry.h"

#include <string>

namespace cli {

struct SceneFile;

// All but the material. Throws JsonRefusal.
ParticleEntry read_particle_entry(const JsonPlace &place, const nlohmann::json &value);

// Reads the files. Throws Failure.
void load_particles(SceneFile &scene);

// Where an entry's file is.
std::string particle_path(const SceneFile &scene, const ParticleEntry &entry);

} // namespace cli
