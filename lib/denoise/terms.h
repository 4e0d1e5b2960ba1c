#pragma once

#include "lib/denoise/halves.h"

#include <algorithm>

namespace pt {

// Symbols of combination.h, for one value.
struct Terms {
    double noise;       // s
    double first_move;  // p
    double second_move; // q
    double first_free;  // D(A) - A
    double second_free; // D(B) - B
    double weight;

    double noise_change() const { // u
        return 0.5 * (first_move - second_move);
    }

    double free_product() const { return first_free * second_free; }

    double limit_product() const { return (first_move - first_free) * (second_move - second_free); }

    // The expected change of the squared error if the filter is right (combination.h).
    double change() const { return noise_change() * (2.0 * noise + noise_change()) + free_product() + limit_product(); }
};

Terms terms_at(const Halves &halves, std::size_t x, std::size_t y, std::size_t channel);

// Returns the faults of a tile (combination.h). The calibrated factor 3 allows for the noise of D(B), which replaces r.
inline double faults(double free_products, double limit_products, double least) {
    const double of_filter = std::max(free_products, 0.0);
    const double of_limits = std::max(limit_products, 0.0);
    return std::max({of_filter - of_limits, 3.0 * (of_limits - of_filter), least});
}

} // namespace pt
