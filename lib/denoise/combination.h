// What lies between a raw and a denoised image, where its error is least, and how large that is: from two images of
// independent noise and what a filter makes of each.
//
// Let A and B be unbiased, independent and of one distribution, with the limit r, and D any filter. With
//
//     M = (A + B) / 2,   F = (D(A) + D(B)) / 2,   d = F - M,   s = (A - B) / 2,   f = (D(A) - D(B)) / 2,
//
// the square of the error of the image M + t d, which is M for t = 0 and F for t = 1, is expected to be that of
//
//     s^2 - 2 t s (s - f) + t^2 d^2.                                                                             (1)
//
// For any a and b of A and B alone, and S = (a + b) / 2: E[(S - r)^2] = E[S^2 - 2 S r + r^2] = E[S^2 - a B - b A + A
// B], as a does not depend on B, nor b on A, nor A on B. With a = A + t (D(A) - A) and b likewise that is (1), after
// some algebra. (The mean of (D(A) - B)^2 less that of (A - B)^2 / 2 is the square of the error of D(A) alone; F has
// less.)
//
// Summed over a place, (1) is least for t = sum s (s - f) / sum d^2, as estimators that shrink have it (James and
// Stein, "Estimation with quadratic loss", 1961). Sums over hundreds of values make (1) at this t too small by little.
#pragma once

#include "lib/denoise/open_image_denoise.h"
#include "lib/film/error_estimate.h"

#include <vector>

namespace pt {

// A, B, D(A) and D(B), each with width times height times 3 values.
struct FilteredHalves {
    std::size_t width;
    std::size_t height;
    const float *first;
    const float *second;
    const float *first_filtered;
    const float *second_filtered;
};

// Writes M + t d, and returns its error.
ErrorEstimate combine(const FilteredHalves &halves, float *to);

} // namespace pt
