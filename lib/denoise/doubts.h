// Keeps pixels raw where denoising might do harm.
#pragma once

#include "lib/denoise/halves.h"

namespace pt {

// In each block of 32x32 pixels, takes back the moves that change the squared error most, until the expected change by
// the other moves, plus two standard errors, is not positive. This holds for errors and for relative errors.
//
// Blocks overlap by half. Each block multiplies a pixel's moves by its window, or by 0 to take them back, and the
// results are added. The windows at a pixel sum to 1, so there are no seams. Squared errors are convex in the moves, so
// the expected change of the whole image is not positive either.
void take_back_doubtful_moves(Halves &halves);

} // namespace pt
