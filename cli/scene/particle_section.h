// The section `particles` of a scene file: files whose particles are spheres of the scene.
#pragma once

#include "cli/base/json_value.h"
#include "cli/data/particle_file.h"
#include "cli/data/particle_look.h"

#include <pt/pt.h>

#include <cstdint>
#include <string>
#include <vector>

namespace cli {

struct SceneFile;

struct ParticleEntry {
    std::string file; // relative to the scene's folder
    ParticleQuery query;
    ParticleRadius radius;
    ParticleColour colour;
    std::uint32_t material = 0; // index, when the whole scene is read

    // What load_particles has read.
    std::vector<double> positions;
    std::vector<float> radii;          // one if all are alike
    std::vector<std::uint8_t> colours; // none: colour.constant

    pt_sphere_array spheres() const; // points into this object
};

// All but the material. Throws JsonRefusal.
ParticleEntry read_particle_entry(const JsonPlace &place, const nlohmann::json &value);

// Reads the files. Throws Failure.
void load_particles(SceneFile &scene);

// Where an entry's file is.
std::string particle_path(const SceneFile &scene, const ParticleEntry &entry);

} // namespace cli
