// A file whose particles are spheres of a scene, and these spheres.
#pragma once

#include "cli/data/particle_colour.h"
#include "cli/data/particle_file.h"
#include "cli/data/particle_radius.h"
#include "cli/data/particles.h"

#include <pt/pt.h>

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace cli {

struct ParticleEntry {
    // As it is asked for.
    std::string file; // relative to the scene's folder
    ParticleQuery query;
    bool wraps = false; // into the periodic box
    ParticleRadius radius;
    ParticleColour colour;
    bool has_material = false; // else it is to have that of a figure
    std::uint32_t material = 0;

    // As load has found it.
    std::vector<double> positions;
    std::vector<float> radii;          // one if all are alike
    std::vector<std::uint8_t> colours; // none: shown_colour.constant
    ParticleRadius shown_radius;       // resolved
    ParticleColour shown_colour;
    std::vector<TypeColour> types; // where they are what colours show
    std::optional<SimulationBox> box;

    std::size_t count() const { return positions.size() / 3; }
    pt_sphere_array spheres() const; // points into this object

    // "vx from -2 to 2", where colours show the range of a column that nobody has given; else empty.
    std::string chosen_range() const;
};

// Reads the file at that path. Throws Failure; UnknownColumn for a column that it lacks; RefusedLook for types that
// have no radius or colour.
void load(ParticleEntry &entry, const std::string &path);

// A radius or a colour that does not fit the particles.
struct RefusedLook : Failure {
    RefusedLook(ExitCode code, const std::string &message, bool is_radius) :
        Failure(code, message),
        of_radius(is_radius) {}

    bool of_radius; // else of the colour
};

} // namespace cli
