// Brings particles that have left a periodic box back into it.
#pragma once

#include "cli/data/particles.h"

namespace cli {

// Moves each particle by whole edges of the box along the edges that are periodic, so that its share of them is at
// least 0 and below 1; those that are there keep their bits. Particles without a box stay as they are. Throws
// Failure(ExitCode::scene) for a box without volume. file: its name, for messages.
void wrap_into_box(Particles &particles, const std::string &file);

} // namespace cli
