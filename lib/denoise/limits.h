// Limits the moves of a denoised image's halves.
#pragma once

#include "lib/denoise/halves.h"

namespace pt {

// Limits each move to two standard errors of a half, and to the values of the halves within 3x3 pixels (limited
// translation: Efron and Morris, "Limiting the risk of Bayes and empirical Bayes estimators", 1971).
//
// The standard error of a half is sqrt(2) s with s = |A - B| / 2. One pixel tells it badly, so s is raised to the
// median around, but at most to 16 s, since normal noise is that far below its deviation in one value of 20. So equal
// halves do not move.
void limit_moves(Halves &halves);

// Shortens the longest moves of each half to one length, where they would shift a channel's mean by more than the
// standard error of the mean of both halves.
void keep_mean(Halves &halves);

} // namespace pt
