// What lies between a raw and a denoised image, where its error is least, and how large that is: from two images of
// independent noise and what a filter makes of each.
//
// Let A and B be unbiased, independent and of one distribution, with the limit r, and D any filter. With
//
//     M = (A + B) / 2,   F = (D(A) + D(B)) / 2,   d = F - M,   s = (A - B) / 2,   f = (D(A) - D(B)) / 2,
//
// the square of the error of the image M + t d, which is M for t = 0 and F for t = 1, is expected to be that of
//
//     ((1 - t) s + t f)^2 + t^2 (A - D(A)) (B - D(B)),                                                           (1)
//
// of noise and of what the filter makes wrong. For let a be made of A alone and b likewise of B, and S = (a + b) / 2:
// (S - r)^2 = ((a - b) / 2)^2 + (a - r) (b - r), and the last product's mean is that of (A - a) (B - b), since A and B,
// which are independent, have the mean r. With a = A + t (D(A) - A) and b likewise that is (1).
//
// Summed over a place, (1) is least for t = sum s (s - f) / sum d^2, as estimators that shrink have it (James and
// Stein, "Estimation with quadratic loss", 1961). Sums over hundreds of values make (1) at this t too small by little.
//
// Faults of the filter may be light that few samples meet, which it takes for noise. Both factors of a product are
// large then where both halves met it in one pixel, hardly ever; most pictures have products below 0 alone. But their
// mean is that of a square. So their sum over a place counts for 0 at least, and for no less than the product of the
// sums of the factors over the values of a tile, over their number: many more samples make that, and the square of a
// sum is at most the sum of squares times their number (Cauchy's inequality).
#pragma once

#include "lib/film/error_estimate.h"

#include <pt/denoise.h>

namespace pt {

// Writes M + t d to info.denoised, and returns its error. The images are A, B, D(A) and D(B).
ErrorEstimate combine(const pt_denoise_info &info, const float *first_filtered, const float *second_filtered);

} // namespace pt
