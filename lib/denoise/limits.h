// How far the halves of a denoised image may move.
#pragma once

#include "lib/denoise/halves.h"

namespace pt {

// Limits each move to two standard errors of a half, and to values that a half has within the 3x3 pixels about it
// (limited translation: Efron and Morris, "Limiting the risk of Bayes and empirical Bayes estimators", 1971).
//
// With s = |A - B| / 2 the standard error of a half is sqrt(2) s. One pixel alone tells it badly, so s is raised to the
// median of those about it, but to no more than 16 s: of normal noise only one value in 20 is that far below its
// deviation. So equal halves do not move at all.
void limit_moves(Halves &halves);

// Shortens the longest moves of each half to one length, where they would shift a channel's mean by more than the
// standard error that the mean of both halves has.
void keep_mean(Halves &halves);

} // namespace pt
