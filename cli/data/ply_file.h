// PLY (Turk 1994, "The PLY Polygon File Format"), as text and binary: the particles are the element vertex.
#pragma once

#include "cli/data/data_stream.h"
#include "cli/data/particle_rows.h"

#include <memory>

namespace cli {

// Throws Failure.
void read_ply(std::unique_ptr<DataStream> stream, ParticleRows &rows);

} // namespace cli
