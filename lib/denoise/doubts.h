#pragma once

#include "lib/denoise/halves.h"

namespace pt {

// In each block of 32x32 pixels, undoes the moves that change the squared error or the relative squared error most
// (shaders/README.md, section 11).
//
// Blocks overlap by half. Each block multiplies a pixel's moves by its window function, or by 0 to undo them, and the
// results are added. The windows of a pixel sum to 1, so there are no seams. In each block the expected change of the
// squared error is at most 0. Squared errors are convex in the moves, so this also holds for the whole image.
void take_back_doubtful_moves(Halves &halves);

} // namespace pt
