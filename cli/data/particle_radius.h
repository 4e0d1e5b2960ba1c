// How large particles are: by a column, by their types or elements, or all alike.
#pragma once

#include "cli/data/particle_file.h"
#include "cli/data/particles.h"

#include <map>
#include <string>
#include <vector>

namespace cli {

enum class RadiusSource { automatic, constant, column, van_der_waals, covalent, types };

struct ParticleRadius {
    RadiusSource source = RadiusSource::automatic;
    double scale = 1.0; // the radius itself where it is constant
    std::string column;
    std::map<std::string, double> types; // by their names
};

// Asks for the columns that it needs.
void ask_for(const ParticleRadius &radius, ParticleQuery &query);

// What an automatic radius is for these particles, times its scale; others as they are. Automatic is the column
// "radius"; else, of elements, the covalent radii, if distances in the data are such as angstroms have; else one for
// all, with which most balls just touch their nearest neighbour.
ParticleRadius resolved(const ParticleRadius &radius, const Particles &particles);

// radius: resolved. One for each particle, or one alone where all are alike. Throws std::invalid_argument for a type
// without a radius.
std::vector<float> radii_of(const Particles &particles, const ParticleRadius &radius);

} // namespace cli
