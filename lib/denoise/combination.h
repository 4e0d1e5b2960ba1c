// Combines two images and their filtered versions into a denoised image, and estimates its error.
//
// The images A and B are independent and have the same distribution with mean r. D is any filter. A move p towards D(A)
// and a move q towards D(B) give a = A + p, b = B + q and the denoised image S = (a + b) / 2. If p depends only on A,
// and q only on B, then with s = (A - B) / 2 and u = (p - q) / 2
//
//     E (S - r)^2 = E ((a - b) / 2)^2 + E (a - r) (b - r) = E (s + u)^2 + E p q.                        (1)
//
// The first term is the variance. The second is the squared bias, called faults in the code.
//
// Without moves the squared error is s^2. The moves change it by 2 s u + u^2 + f, where f are the faults. Moves are
// limited (limits.h), undone where they may raise the error (doubts.h), and clipped to keep the mean.
//
// Limits depend on both halves, so (1) holds only for the free moves v = D(A) - A and w = D(B) - B. Limited moves add E
// (p - v) (B - r) + E (q - w) (A - r). If the filter is right, D(A) and D(B) estimate r, and the faults are v w + (p -
// v) (q - w). If the limits undo a wrong filter, p - v = -v, both products are equal, and the faults are 0. So the
// faults of a tile are computed as the difference between the sums of both products. A lower bound is (sum p) (sum q) /
// n for n values (Cauchy's inequality).
#pragma once

#include "lib/film/error_estimate.h"

#include <pt/denoise.h>

namespace pt {

// Writes the image to info.denoised and returns its error.
ErrorEstimate combine(const pt_denoise_info &info, const float *first_filtered, const float *second_filtered);

} // namespace pt
