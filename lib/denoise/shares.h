#pragma once

#include "lib/denoise/tiles.h"

namespace pt {

// Returns t of combination.h for each tile. The moves must already be limited.
Tiles best_shares(const Halves &halves);

} // namespace pt
