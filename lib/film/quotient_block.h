// The floats of quotient.h for eight pixels with the same numbers of samples at once: loops over the pixels, without
// branches and in double, which compilers turn into vector instructions.
#pragma once

#include "shaders/gpu_layout.h"

#include <array>
#include <cstddef>
#include <cstdint>

namespace pt {

inline constexpr std::size_t block_pixels = gpu::TILE_SIZE;

// The sums of one part, in planes of words, the least significant first.
struct BlockSums {
    const std::uint32_t *words; // of the first pixel and plane
    std::size_t stride;         // from a plane to the next
};

// One number of each pixel.
using BlockFloats = std::array<float, block_pixels>;

// Not 0 where a pixel's floats are not certain: unusually large sums, and quotients too close to the middle of two
// floats, are left to quotient.h.
using BlockDoubts = std::array<std::uint32_t, block_pixels>;

bool has_any(const BlockDoubts &doubts);

struct BlockEstimates {
    BlockFloats mean;
    BlockFloats standard_error;
    BlockFloats lesser; // of the means of the parts
};

class BlockQuotients {
public:
    // a, b: samples of a pixel in the parts, at least one in both together.
    BlockQuotients(std::uint32_t a, std::uint32_t b, int exponent);

    bool are_of(std::uint32_t a, std::uint32_t b) const { return a == a_ && b == b_; }

    BlockDoubts means(const BlockSums &a, const BlockSums &b, BlockFloats &to) const;

    // For parts with at least one sample each.
    BlockDoubts estimates(const BlockSums &a, const BlockSums &b, BlockEstimates &to) const;

private:
    // A factor of whole numbers.
    struct Scale {
        double factor = 1.0;
        double margin_if_exact = 0.0; // of a product of a number without rounding, as a share of it
    };

    static Scale scale_of(double factor);

    std::uint32_t a_;
    std::uint32_t b_;
    Scale mean_;
    Scale mean_a_;
    Scale mean_b_;
    Scale error_; // of the difference of the parts' sums with these weights
    double weight_a_ = 1.0;
    double weight_b_ = 1.0;
    std::uint32_t unusual_ = 0; // bits of the third word
    std::uint32_t doubt_of_all_ = 0;
};

} // namespace pt
