// Undoes the denoising of pixels where it might raise the error.
#pragma once

#include "lib/denoise/halves.h"

namespace pt {

// In each block of 32x32 pixels, undoes the moves that change the squared error or the relative squared error most
// (shaders/README.md, section 11).
//
// Blocks overlap by half. Each block multiplies a pixel's moves by its window function, or by 0 to undo them, and the
// results are added. The windows of a pixel sum to 1, so there are no seams. Squared errors are convex in the moves, so
// the expected change of the whole image is not positive either.
void take_back_doubtful_moves(Halves &halves);

} // namespace pt
