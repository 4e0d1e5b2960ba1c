// Combines two images and their filtered versions into a denoised image, and estimates its error.
//
// The images A and B are independent and have the same distribution with mean r. D is any filter. A move p towards D(A)
// and a move q towards D(B) give the halves a = A + p and b = B + q of the image S = (a + b) / 2. If p depends on A
// alone, and q on B alone, then with s = (A - B) / 2 and u = (p - q) / 2
//
//     E (S - r)^2 = E ((a - b) / 2)^2 + E (a - r) (b - r) = E (s + u)^2 + E p q.                        (1)
//
// The first term is the variance. The second is the squared bias, called the faults.
//
// Moves are limited (limits.h), then scaled by a share t in [0, 1]. With faults f, the sum of
// s^2 + 2 s u t + (u^2 + f) t^2 is least at t = -sum s u / (sum u^2 + f) (James and Stein, "Estimation with quadratic
// loss", 1961). The smallest of four such t is used: for absolute and for relative errors, each with all pixels and
// without the pixel of each tile that gains most.
//
// Limits depend on both halves, so (1) holds only for the free moves v = t (D(A) - A) and w = t (D(B) - B). Limited
// moves add E (p - v) (B - r) + E (q - w) (A - r). Where the filter is right, D(A) and D(B) estimate r, and the faults
// are v w + (p - v) (q - w). Where the limits undo a wrong filter, p - v = -v: both products are equal, and there are
// no faults. The faults of a tile are therefore the difference between the sums of both products. A lower bound is
// (sum p) (sum q) / n for n values (Cauchy's inequality).
#pragma once

#include "lib/film/error_estimate.h"

#include <pt/denoise.h>

namespace pt {

// Writes the image to info.denoised and returns its error.
ErrorEstimate combine(const pt_denoise_info &info, const float *first_filtered, const float *second_filtered);

} // namespace pt
