// The particles of a figure, by the options of `pt figure`.
#pragma once

#include "cli/figure/figure_options.h"
#include "cli/figure/legend.h"
#include "cli/scene/particle_entry.h"

namespace cli {

// Reads the file. Throws Failure, which names the option that is at fault; ExitCode::file for a file without particles.
ParticleEntry read_figure_particles(const FigureOptions &options);

Legend legend_of(const ParticleEntry &particles);

} // namespace cli
