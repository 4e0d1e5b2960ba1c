// Which colours particles have: by a column of numbers, by their types, by three columns, or all alike.
#pragma once

#include "cli/data/particle_file.h"
#include "cli/data/particles.h"

#include <array>
#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <vector>

namespace cli {

using DisplayColour = std::array<std::uint8_t, 3>; // encoded by sRGB

enum class ColourSource { automatic, constant, type, components, map };

struct ParticleColour {
    ColourSource source = ColourSource::automatic;
    std::array<float, 3> constant{1.0F, 1.0F, 1.0F}; // linear
    std::vector<std::string> columns;                // red, green and blue, encoded by sRGB; or the one that is mapped
    std::string map = "viridis";                     // of colour_map_names
    std::optional<std::array<double, 2>> range;      // of the columns
    std::map<std::string, DisplayColour> types;      // by their names; where there are any, all of them
};

struct TypeColour {
    std::string name;
    DisplayColour colour;
};

// Asks for the columns that it needs.
void ask_for(const ParticleColour &colour, ParticleQuery &query);

// What colours mean for these particles: neither automatic nor without a range. Automatic are those of elements or
// other types, else the columns "red", "green" and "blue", else a light grey for all. A column of words has the colours
// of types. A range that is not given is that of the column; of red, green and blue 0 to 1 or, where one is larger, 0
// to 255.
ParticleColour resolved(const ParticleColour &colour, const Particles &particles);

// colour: resolved, as for all below. R, G and B of each particle; none where the colour is constant. Throws
// std::invalid_argument for a type that a table lacks.
std::vector<std::uint8_t> colours_of(const Particles &particles, const ParticleColour &colour);

// Of the types that there are, where types have colours. Elements have Jmol's; others the seven of Okabe and Ito 2008
// that are not black, in turn, by their number or their order in the file.
std::vector<TypeColour> type_colours(const Particles &particles, const ParticleColour &colour);

} // namespace cli
