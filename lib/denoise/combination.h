// A denoised image and its error, from two images of independent noise and what a filter makes of each.
//
// Let A and B be unbiased, independent and of one distribution, with mean r, and D any filter. Moves p towards D(A) and
// q towards D(B) give the halves a = A + p and b = B + q and the image S = (a + b) / 2. If p depends on A alone and q
// on B, then with s = (A - B) / 2 and u = (p - q) / 2
//
//     E (S - r)^2 = E ((a - b) / 2)^2 + E (a - r) (b - r) = E (s + u)^2 + E p q,                        (1)
//
// where (s + u)^2 is variance and p q squared bias, the faults below.
//
// Moves are limited (limits.h), then scaled by a share t of 0 to 1. For faults f, the sum of s^2 + 2 s u t + (u^2 + f)
// t^2 is least at t = -sum s u / (sum u^2 + f) (James and Stein, "Estimation with quadratic loss", 1961). The least t
// of four is taken: by errors and relative errors, with all pixels and without the one of each tile that gains most.
// Last, the mean is kept.
//
// Limits use both halves, so (1) holds only for free moves v = t (D(A) - A) and w, of B. Other moves add E (p - v) (B -
// r) + (q - w) (A - r). Where the filter is right, D(B) and D(A) stand for r, and the faults are v w + (p - v) (q - w).
// Where it is wrong, and limits mend it, p - v is -v: both products are equal, and there are no faults. So the faults
// of a tile are the difference between the sums of both products. They are at least (sum p) (sum q) over the number of
// values (Cauchy's inequality); products of light that few samples meet are mostly below 0.
#pragma once

#include "lib/film/error_estimate.h"

#include <pt/denoise.h>

namespace pt {

// Writes the image to info.denoised, and returns its error. The images are D(A) and D(B).
ErrorEstimate combine(const pt_denoise_info &info, const float *first_filtered, const float *second_filtered);

} // namespace pt
