// Combines two images and their filtered versions into a denoised image, and estimates its error.
//
// shaders/README.md, section 11, defines the symbols and derives E (S - r)^2 = E (s + u)^2 + E p q. The last term is
// called faults. Moves change the squared error s^2 by 2 s u + u^2 + f, where f are the faults.
//
// Limits depend on both halves, so the equation holds only for the free moves v = D(A) - A and w = D(B) - B. Limited
// moves add E (p - v) (B - r) + E (q - w) (A - r). If D(A) and D(B) are unbiased, they may replace r, and the faults
// are v w + (p - v) (q - w). If the limits undo a wrong filter, p - v = -v, both products are equal, and the faults are
// 0. So the faults of a tile are computed as the difference between the sums of both products. A lower bound is (sum p)
// (sum q) / n for n values (Cauchy's inequality).
#pragma once

#include "lib/film/error_estimate.h"

#include <pt/denoise.h>

namespace pt {

// Writes the image to info.denoised and returns its error.
ErrorEstimate combine(const pt_denoise_info &info, const float *first_filtered, const float *second_filtered);

} // namespace pt
