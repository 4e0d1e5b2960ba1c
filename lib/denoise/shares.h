// By how much the denoiser's change of a tile is scaled.
#pragma once

#include "lib/denoise/tiles.h"

namespace pt {

// The t of combination.h for each tile. The moves must be limited.
Tiles best_shares(const Halves &halves);

} // namespace pt
