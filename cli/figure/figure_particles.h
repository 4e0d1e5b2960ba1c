// The particles of a figure with what they look like: a radius for all, and a colour for each.
#pragma once

#include "cli/data/particles.h"
#include "cli/figure/figure_options.h"
#include "cli/figure/legend.h"

#include <cstdint>
#include <vector>

namespace cli {

struct FigureParticles {
    Particles data;
    std::vector<double> radii;          // of each, or one for all
    std::vector<DisplayColour> palette; // at least one
    std::vector<std::uint32_t> colours; // of each particle, an index into the palette
    Legend legend;
};

// Reads the file. Throws Failure, ExitCode::file for a file without particles.
FigureParticles read_figure_particles(const FigureOptions &options);

} // namespace cli
