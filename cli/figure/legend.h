// The legend of a figure, as a picture of its own (SVG 1.1), to be placed where the page has room.
#pragma once

#include "cli/data/particle_colour.h"

#include <optional>
#include <string>
#include <vector>

namespace cli {

// Numbers as colours, from the first colour for low to the last for high, evenly spaced.
struct ColourBar {
    double low;
    double high;
    std::vector<DisplayColour> colours; // at least two
};

struct Swatch {
    std::string name;
    DisplayColour colour;
};

struct Legend {
    std::string title; // what the colours say: the name of a column
    std::optional<ColourBar> bar;
    std::vector<Swatch> swatches; // where there is no bar
};

// Numbers of the form 1, 2 or 5 times a power of ten within [low, high], at most most_count (2 or more) of them.
std::vector<double> tick_values(double low, double high, std::size_t most_count);

// Well-formed XML whatever the names are: what XML or UTF-8 does not allow becomes U+FFFD.
std::string legend_svg(const Legend &legend);

} // namespace cli
