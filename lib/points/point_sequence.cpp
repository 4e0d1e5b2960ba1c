#include "lib/points/point_sequence.h"

#include "lib/base/mixed.h"

#include <pt/pt.h>

#include <algorithm>
#include <bit>
#include <cstddef>

namespace pt {

namespace {

// A primitive polynomial over GF(2), highest power first, and initial direction numbers.
struct SobolDimension {
    std::uint32_t polynomial;
    std::array<std::uint32_t, 9> initial;
};

// Joe and Kuo 2008, new-joe-kuo-6, dimensions 2 to 64. Dimension 1 is the radical inverse in base 2.
constexpr SobolDimension joe_kuo[sequence_dimensions - 1] = {
    {3, {1}},
    {7, {1, 3}},
    {11, {1, 3, 1}},
    {13, {1, 1, 1}},
    {19, {1, 1, 3, 3}},
    {25, {1, 3, 5, 13}},
    {37, {1, 1, 5, 5, 17}},
    {41, {1, 1, 5, 5, 5}},
    {47, {1, 1, 7, 11, 19}},
    {55, {1, 1, 5, 1, 1}},
    {59, {1, 1, 1, 3, 11}},
    {61, {1, 3, 5, 5, 31}},
    {67, {1, 3, 3, 9, 7, 49}},
    {91, {1, 1, 1, 15, 21, 21}},
    {97, {1, 3, 1, 13, 27, 49}},
    {103, {1, 1, 1, 15, 7, 5}},
    {109, {1, 3, 1, 15, 13, 25}},
    {115, {1, 1, 5, 5, 19, 61}},
    {131, {1, 3, 7, 11, 23, 15, 103}},
    {137, {1, 3, 7, 13, 13, 15, 69}},
    {143, {1, 1, 3, 13, 7, 35, 63}},
    {145, {1, 3, 5, 9, 1, 25, 53}},
    {157, {1, 3, 1, 13, 9, 35, 107}},
    {167, {1, 3, 1, 5, 27, 61, 31}},
    {171, {1, 1, 5, 11, 19, 41, 61}},
    {185, {1, 3, 5, 3, 3, 13, 69}},
    {191, {1, 1, 7, 13, 1, 19, 1}},
    {193, {1, 3, 7, 5, 13, 19, 59}},
    {203, {1, 1, 3, 9, 25, 29, 41}},
    {211, {1, 3, 5, 13, 23, 1, 55}},
    {213, {1, 3, 7, 3, 13, 59, 17}},
    {229, {1, 3, 1, 3, 5, 53, 69}},
    {239, {1, 1, 5, 5, 23, 33, 13}},
    {241, {1, 1, 7, 7, 1, 61, 123}},
    {247, {1, 1, 7, 9, 13, 61, 49}},
    {253, {1, 3, 3, 5, 3, 55, 33}},
    {285, {1, 3, 1, 15, 31, 13, 49, 245}},
    {299, {1, 3, 5, 15, 31, 59, 63, 97}},
    {301, {1, 3, 1, 11, 11, 11, 77, 249}},
    {333, {1, 3, 1, 11, 27, 43, 71, 9}},
    {351, {1, 1, 7, 15, 21, 11, 81, 45}},
    {355, {1, 3, 7, 3, 25, 31, 65, 79}},
    {357, {1, 3, 1, 1, 19, 11, 3, 205}},
    {361, {1, 1, 5, 9, 19, 21, 29, 157}},
    {369, {1, 3, 7, 11, 1, 33, 89, 185}},
    {391, {1, 3, 3, 3, 15, 9, 79, 71}},
    {397, {1, 3, 7, 11, 15, 39, 119, 27}},
    {425, {1, 1, 3, 1, 11, 31, 97, 225}},
    {451, {1, 1, 1, 3, 23, 43, 57, 177}},
    {463, {1, 3, 7, 7, 17, 17, 37, 71}},
    {487, {1, 3, 1, 5, 27, 63, 123, 213}},
    {501, {1, 1, 3, 5, 11, 43, 53, 133}},
    {529, {1, 3, 5, 5, 29, 17, 47, 173, 479}},
    {539, {1, 3, 3, 11, 3, 1, 109, 9, 69}},
    {545, {1, 1, 1, 5, 17, 39, 23, 5, 343}},
    {557, {1, 3, 1, 5, 25, 15, 31, 103, 499}},
    {563, {1, 1, 1, 11, 11, 17, 63, 105, 183}},
    {601, {1, 1, 5, 11, 9, 29, 97, 231, 363}},
    {607, {1, 1, 5, 15, 19, 45, 41, 7, 383}},
    {617, {1, 3, 7, 7, 31, 19, 83, 137, 221}},
    {623, {1, 1, 1, 3, 23, 15, 111, 223, 83}},
    {631, {1, 1, 5, 13, 31, 15, 55, 25, 161}},
    {637, {1, 1, 3, 13, 25, 47, 39, 87, 257}},
};

using Matrix = std::array<std::uint32_t, 32>;

// v_k = m_k 2^(32 - k) by the recurrence of Bratley and Fox (ACM TOMS 14, 1988, section 2).
constexpr Matrix direction_numbers(std::uint32_t dimension) {
    Matrix v{};
    if (dimension == 0) {
        for (std::uint32_t k = 0; k < 32; ++k)
            v[k] = 0x80000000U >> k;
        return v;
    }
    const SobolDimension &source = joe_kuo[dimension - 1];
    const auto degree = static_cast<std::uint32_t>(std::bit_width(source.polynomial)) - 1;
    for (std::uint32_t k = 0; k < 32; ++k) {
        if (k < degree) {
            v[k] = source.initial[k] << (31 - k);
            continue;
        }
        v[k] = v[k - degree] ^ (v[k - degree] >> degree);
        for (std::uint32_t i = 1; i < degree; ++i)
            if ((source.polynomial >> (degree - i) & 1) != 0)
                v[k] ^= v[k - i];
    }
    return v;
}

constexpr std::array<Matrix, sequence_dimensions> sobol_matrices = [] {
    std::array<Matrix, sequence_dimensions> matrices{};
    for (std::uint32_t dimension = 0; dimension < sequence_dimensions; ++dimension)
        matrices[dimension] = direction_numbers(dimension);
    return matrices;
}();

// With motion, the third number is the time. The fifth dimension gives it a smaller error.
constexpr std::uint32_t dimension_of(std::uint32_t number, bool motion) {
    constexpr std::uint32_t order[] = {0, 1, 4, 2, 3};
    return motion && number < std::size(order) ? order[number] : number;
}

constexpr std::uint32_t reversed_bits(std::uint32_t x) {
    x = (x >> 16) | (x << 16);
    x = (x & 0xff00ff00U) >> 8 | (x & 0x00ff00ffU) << 8;
    x = (x & 0xf0f0f0f0U) >> 4 | (x & 0x0f0f0f0fU) << 4;
    x = (x & 0xccccccccU) >> 2 | (x & 0x33333333U) << 2;
    return (x & 0xaaaaaaaaU) >> 1 | (x & 0x55555555U) << 1;
}

constexpr std::array<std::uint32_t, sequence_dimensions> primes = [] {
    std::array<std::uint32_t, sequence_dimensions> found{};
    std::size_t count = 0;
    for (std::uint32_t candidate = 2; count < found.size(); ++candidate) {
        bool prime = true;
        for (std::size_t i = 0; i < count; ++i)
            prime = prime && candidate % found[i] != 0;
        if (prime)
            found[count++] = candidate;
    }
    return found;
}();

} // namespace

std::uint32_t sobol(std::uint32_t index, std::uint32_t dimension) {
    std::uint32_t x = 0;
    for (std::uint32_t rest = index; rest != 0; rest &= rest - 1)
        x ^= sobol_matrices[dimension][static_cast<std::uint32_t>(std::countr_zero(rest))];
    return x;
}

std::uint32_t radical_inverse(std::uint64_t index, std::uint32_t dimension) {
    // For index = sum d_k b^k with K digits, reversed = sum d_k b^(K - 1 - k).
    const std::uint64_t base = primes[dimension];
    std::uint64_t reversed = 0;
    std::uint64_t power = 1; // b^K <= 311 * 2^35
    for (std::uint64_t rest = index; rest != 0; rest /= base) {
        reversed = reversed * base + rest % base;
        power *= base;
    }
    __extension__ using Wide = unsigned __int128;
    return static_cast<std::uint32_t>((Wide{reversed} << 32) / power);
}

// Reverses the bits, so that carries make each digit depend on more significant ones (Laine and Karras 2011; Burley
// 2020). The constants are from Vegdahl 2021.
std::uint32_t owen_scrambled(std::uint32_t coordinate, std::uint32_t seed) {
    std::uint32_t v = reversed_bits(coordinate);
    v ^= v * 0x3d20adeaU;
    v += seed;
    v *= (seed >> 16) | 1U;
    v ^= v * 0x05526c56U;
    v ^= v * 0x53a22864U;
    return reversed_bits(v);
}

namespace {

using Point = std::vector<std::uint32_t>;

// From index 2^32 on, points repeat, but with other seeds.
std::vector<std::uint32_t> scrambling_seeds(std::uint64_t seed, std::uint64_t repetition, std::uint32_t dimensions) {
    std::vector<std::uint32_t> seeds;
    std::uint64_t state = mixed(seed) + repetition;
    for (std::uint32_t dimension = 0; dimension < dimensions; ++dimension)
        seeds.push_back(static_cast<std::uint32_t>(mixed(state = mixed(state)) >> 32));
    return seeds;
}

class PointWriter {
public:
    PointWriter(std::uint32_t sampler, std::uint64_t seed, const PointLayout &layout) :
        sobol_(sampler == PT_SAMPLER_SOBOL),
        has_time_(layout.has_time()),
        seed_(seed),
        point_(layout.dimensions_of(layout.block_count())) {}

    std::span<const std::uint32_t> coordinates(std::uint64_t index, std::uint32_t first, std::uint32_t end) {
        const std::span<std::uint32_t> coordinates = std::span(point_).subspan(first, end - first);
        if (sobol_)
            seed(index >> 32);
        for (std::uint32_t i = 0; i < coordinates.size(); ++i)
            coordinates[i] =
                sobol_ ? owen_scrambled(sobol(static_cast<std::uint32_t>(index), dimension_of(first + i, has_time_)),
                                        seeds_[first + i])
                       : radical_inverse(index, first + i);
        return coordinates;
    }

private:
    void seed(std::uint64_t repetition) {
        if (!seeds_.empty() && repetition == repetition_)
            return;
        repetition_ = repetition;
        seeds_ = scrambling_seeds(seed_, repetition, static_cast<std::uint32_t>(point_.size()));
    }

    bool sobol_;
    bool has_time_;
    std::uint64_t seed_;
    std::uint64_t repetition_ = 0;
    std::vector<std::uint32_t> seeds_;
    Point point_;
};

} // namespace

std::vector<PointBlock> point_table(std::uint32_t sampler, std::uint64_t seed, std::span<const std::uint32_t> indices,
                                    const PointLayout &layout) {
    std::vector<PointBlock> table;
    table.reserve(indices.size() * layout.row_blocks());
    PointWriter writer(sampler, seed, layout);
    const std::span<const std::uint32_t> block_dimensions = layout.block_dimensions;
    const auto add_blocks = [&](std::span<const std::uint32_t> coordinates, std::span<const std::uint32_t> blocks) {
        for (const std::uint32_t count : blocks) {
            PointBlock block{};
            std::ranges::copy(coordinates.first(count), block.begin());
            coordinates = coordinates.subspan(count);
            table.push_back(block);
        }
    };
    const auto shared_blocks = block_dimensions.first(layout.shared_blocks);
    const auto branch_blocks = block_dimensions.subspan(layout.shared_blocks);
    const std::uint32_t shared = layout.dimensions_of(layout.shared_blocks);
    const std::uint32_t all = layout.dimensions_of(layout.block_count());
    for (const std::uint32_t index : indices) {
        add_blocks(writer.coordinates(index, 0, shared), shared_blocks);
        for (std::uint32_t branch = 0; branch < layout.branches; ++branch)
            add_blocks(writer.coordinates(std::uint64_t{index} * layout.branches + branch, shared, all), branch_blocks);
    }
    return table;
}

} // namespace pt
