// How large particles are and which colours they have, by their columns and types.
#pragma once

#include "cli/data/particles.h"

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace cli {

enum class RadiusSource { constant, column, van_der_waals, covalent };

struct ParticleRadius {
    RadiusSource source = RadiusSource::constant;
    double scale = 1.0; // the radius itself where it is constant
    std::string column;
};

enum class ColourSource { constant, type, components, map };

struct ParticleColour {
    ColourSource source = ColourSource::constant;
    std::array<float, 3> constant{1.0F, 1.0F, 1.0F}; // linear
    std::vector<std::string> columns;                // red, green and blue, encoded by sRGB; or the number to be mapped
    std::string map = "viridis";                     // of colour_map_names
    std::optional<std::array<double, 2>> range;      // of the columns; see colours_of where it is not given
};

// The columns that a file must have for them.
std::vector<std::string> look_columns(const ParticleRadius &radius, const ParticleColour &colour);

// One radius for each particle, or one alone where all are alike. Throws std::invalid_argument for types that are no
// elements with a radius.
std::vector<float> radii_of(const Particles &particles, const ParticleRadius &radius);

// R, G and B of each particle, encoded by sRGB; none where the colour is constant. Elements have Jmol's colours; other
// types the seven of Okabe and Ito 2008 that are not black, in turn, by their number or their order in the file. A
// range that is not given is that of the column; of red, green and blue 0 to 1 or, where one is larger, 0 to 255.
std::vector<std::uint8_t> colours_of(const Particles &particles, const ParticleColour &colour);

} // namespace cli
