#include "lib/film/quotient_block.h"

#include "lib/film/quotient.h"
#include "shaders/dialects.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <numeric>

namespace pt {

namespace {

using gpu::less_of;
using gpu::more_of;

// The sum of two whole numbers below 2^53, the first times 2^32.
struct WideNumber {
    double value; // rounded once
    double lost;  // by that: 0 if nothing was

    WideNumber(double high, double low) : value(0x1p32 * high + low), lost(low - (value - 0x1p32 * high)) {}
};

// Far more than the few roundings of a quotient, each at most a 2^53th.
constexpr double margin_of_roundings = 0x1p-50;

double margin(const WideNumber &number, double margin_if_exact) {
    return number.lost == 0.0 ? margin_if_exact : margin_of_roundings;
}

// A number made smaller and larger by a share of itself: the bits in which the two rounded floats differ. If there are
// none, all numbers in between are rounded to the same float (Ziv 1991, see quotient.cpp).
std::uint32_t round_alike(double approximate, double share, float &rounded) {
    rounded = static_cast<float>(approximate - share * approximate);
    return std::bit_cast<std::uint32_t>(rounded) ^
           std::bit_cast<std::uint32_t>(static_cast<float>(approximate + share * approximate));
}

// The three words of a usual sum; the two above the first make one number, which is exact.
struct Words {
    double low;
    double high;

    Words(const BlockSums &sums, std::size_t pixel) :
        low(static_cast<double>(sums.words[pixel])),
        high(static_cast<double>(sums.words[pixel + 2 * sums.stride]) * 0x1p32 +
             static_cast<double>(sums.words[pixel + sums.stride])) {}
};

std::uint32_t bits_of(const BlockSums &sums, std::size_t pixel, std::uint32_t of_third) {
    return sums.words[pixel + 3 * sums.stride] | (sums.words[pixel + 2 * sums.stride] & of_third);
}

} // namespace

bool has_any(const BlockDoubts &doubts) {
    std::uint32_t any = 0;
    for (const std::uint32_t doubt : doubts)
        any |= doubt;
    return any != 0;
}

// A factor that is a power of two loses nothing, so numbers in the middle of two floats are known to be there. Whole
// numbers > 0 times a usual factor are at least the least normal float, and finite in double. Other factors are left to
// quotient.h.
BlockQuotients::Scale BlockQuotients::scale_of(double factor) {
    if (!(factor >= 0x1p-126 && factor <= 0x1p126))
        return {0.0, 0.0};
    int exponent = 0;
    return {factor, std::frexp(factor, &exponent) == 0.5 ? 0.0 : margin_of_roundings};
}

BlockQuotients::BlockQuotients(std::uint32_t a, std::uint32_t b, int exponent) : a_(a), b_(b) {
    const double unit = std::ldexp(1.0, exponent);
    mean_ = scale_of(unit / (static_cast<double>(a) + b));
    std::uint32_t most = 1; // of the weights
    if (a > 0 && b > 0) {
        mean_a_ = scale_of(unit / a);
        mean_b_ = scale_of(unit / b);
        const std::uint32_t factor = std::gcd(a, b);
        const std::uint32_t part_of_a = a / factor;
        const std::uint32_t part_of_b = b / factor;
        weight_a_ = part_of_b;
        weight_b_ = part_of_a;
        most = std::max(part_of_a, part_of_b);
        error_ = scale_of(unit * PartWeights(a, b).scale() * factor);
    }
    const auto is_usual = [](const Scale &scale) { return scale.factor > 0.0; };
    if (most > 1U << 20 || !is_usual(mean_) || !is_usual(mean_a_) || !is_usual(mean_b_) || !is_usual(error_))
        doubt_of_all_ = 1;
    else // words times weights are below 2^52, and so are pairs of the second and third
        unusual_ = ~((1U << 20) / std::bit_ceil(most) - 1);
}

BlockDoubts BlockQuotients::means(const BlockSums &a, const BlockSums &b, BlockFloats &to) const {
    BlockDoubts doubts;
    const Scale scale = mean_;
    for (std::size_t i = 0; i < block_pixels; ++i) {
        const Words words_a(a, i);
        const Words words_b(b, i);
        const WideNumber sum(words_a.high + words_b.high, words_a.low + words_b.low);
        doubts[i] = doubt_of_all_ | bits_of(a, i, unusual_) | bits_of(b, i, unusual_) |
                    round_alike(sum.value * scale.factor, margin(sum, scale.margin_if_exact), to[i]);
    }
    return doubts;
}

BlockDoubts BlockQuotients::estimates(const BlockSums &a, const BlockSums &b, BlockEstimates &to) const {
    BlockDoubts doubts;
    const auto [scale, scale_a, scale_b, scale_of_error] = std::array{mean_, mean_a_, mean_b_, error_};
    for (std::size_t i = 0; i < block_pixels; ++i) {
        const Words words_a(a, i);
        const Words words_b(b, i);
        const WideNumber sum_a(words_a.high, words_a.low);
        const WideNumber sum_b(words_b.high, words_b.low);
        const WideNumber sum(words_a.high + words_b.high, words_a.low + words_b.low);
        const WideNumber difference(words_a.high * weight_a_ - words_b.high * weight_b_,
                                    words_a.low * weight_a_ - words_b.low * weight_b_);
        const double mean_a = sum_a.value * scale_a.factor;
        const double mean_b = sum_b.value * scale_b.factor;
        const double margin_a = margin(sum_a, scale_a.margin_if_exact);
        const double margin_b = margin(sum_b, scale_b.margin_if_exact);
        doubts[i] = doubt_of_all_ | bits_of(a, i, unusual_) | bits_of(b, i, unusual_) |
                    round_alike(sum.value * scale.factor, margin(sum, scale.margin_if_exact), to.mean[i]) |
                    round_alike(std::abs(difference.value) * scale_of_error.factor,
                                margin(difference, scale_of_error.margin_if_exact), to.standard_error[i]) |
                    round_alike(less_of(mean_a, mean_b), more_of(margin_a, margin_b), to.lesser[i]); // either may be it
    }
    return doubts;
}

} // namespace pt
