// By what share moves are scaled.
#pragma once

#include "lib/denoise/tiles.h"

namespace pt {

// The t of combination.h for each tile, of the halves' moves, which are limited.
Tiles best_shares(const Halves &halves);

} // namespace pt
