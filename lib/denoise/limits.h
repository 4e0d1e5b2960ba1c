#pragma once

#include "lib/denoise/halves.h"

namespace pt {

// A move is the filter's change of a value. Limits moves to two standard errors of a half, and moved values to the
// range of both halves within 3x3 pixels. This is limited translation (Efron and Morris 1971).
//
// The standard error of a half is sqrt(2) s with s = |A - B| / 2. An estimate from one pixel is uncertain, so s is
// raised to the median of the 3x3 pixels, but at most to 16 s.
void limit_moves(Halves &halves);

// Clips the longest moves of each half, so that they shift a channel's mean by at most one standard error.
void keep_mean(Halves &halves);

} // namespace pt
