// A value's contributions to the error, in the names of combination.h.
#pragma once

#include "lib/denoise/halves.h"

#include <algorithm>

namespace pt {

struct Terms {
    double noise;       // s
    double first_move;  // p
    double second_move; // q
    double first_free;  // D(A) - A
    double second_free; // D(B) - B
    double weight;      // weight of relative squares

    double noise_change() const { // u
        return 0.5 * (first_move - second_move);
    }
};

Terms terms_at(const Halves &halves, std::size_t x, std::size_t y, std::size_t channel);

// The faults of a tile by combination.h. Limited moves count three times, since D(B), which stands for r, has a part of
// the noise of B: calibrated.
inline double faults(double free_products, double limit_products, double least) {
    const double of_filter = std::max(free_products, 0.0);
    const double of_limits = std::max(limit_products, 0.0);
    return std::max({of_filter - of_limits, 3.0 * (of_limits - of_filter), least});
}

} // namespace pt
