// A denoised image and its error, from two images of independent noise and what a filter makes of each.
//
// Let A and B be unbiased, independent and of one distribution, with the limit r, and D any filter. The halves
// a = A + p and b = B + q move by p, of D(A) - A, and q, of D(B) - B, and the image is S = (a + b) / 2. With
//
//     s = (A - B) / 2,   u = (p - q) / 2
//
// the square of the image's error is expected to be that of
//
//     ((a - b) / 2)^2 + (A - a) (B - b) = (s + u)^2 + p q,                                                        (1)
//
// of noise and of faults, where p is made of A alone and q of B. For (S - r)^2 = ((a - b) / 2)^2 + (a - r) (b - r), and
// the last product's mean is that of (A - a) (B - b), since A and B, which are independent, have the mean r.
//
// Moves are first limited to what the halves support (limits.h). Then they are scaled by a share t of 0 to 1. With the
// faults f of a place the sum of (1) is that of s^2 + 2 s u t + (u^2 + f) t^2, which is least for t = -sum s u / (sum
// u^2 + f) (James and Stein, "Estimation with quadratic loss", 1961). The least t of four is taken: by squares of
// errors and of relative errors, with all pixels and without the one of each tile that gains most, as one pixel proves
// little. Last, the mean is kept.
//
// Limits know both halves, so the moves p and q are not independent. (1) holds for free moves v = t (D(A) - A) and w,
// of B. For others the mean of (p - v) (B - r) + (q - w) (A - r) is added. Where the filter is right, D(B) and D(A)
// stand for r, and the faults are v w + (p - v) (q - w). Where the filter is wrong, and limits mend it, p - v is -v:
// both products are equal, and the fault is none. So the faults of a place are the difference between the sums of both
// products. They are also no less than the product of the sums of p and q over the values of a tile, over their number:
// the square of a sum is at most the sum of squares times their number (Cauchy's inequality), and light that few
// samples meet has products below 0 in most pictures.
#pragma once

#include "lib/film/error_estimate.h"

#include <pt/denoise.h>

namespace pt {

// Writes the image to info.denoised, and returns its error. The images are D(A) and D(B).
ErrorEstimate combine(const pt_denoise_info &info, const float *first_filtered, const float *second_filtered);

} // namespace pt
