// Checks whether points are nets in base 2, and how many binary digits numbers have in common. Used by the tests of
// point sequences and their table.
#pragma once

#include <algorithm>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <vector>

using Coordinates = std::vector<std::uint32_t>; // multiples of 2^-32

// Whether each interval [i, i + 1) / 2^digits holds equally many of the points; there are at least as many points.
inline bool fills_intervals(const Coordinates &points, std::uint32_t digits) {
    std::vector<std::uint32_t> hits(std::size_t{1} << digits);
    for (const std::uint32_t point : points)
        ++hits[std::uint64_t{point} >> (32 - digits)];
    return std::ranges::all_of(hits, [&](std::uint32_t count) { return count == points.size() >> digits; });
}

// Whether each box of 2^-digits_x by 2^-digits_y holds exactly one of 2^(digits_x + digits_y) points.
inline bool fills_boxes(const Coordinates &x, const Coordinates &y, std::uint32_t digits_x, std::uint32_t digits_y) {
    std::vector<std::uint32_t> hits(x.size());
    for (std::size_t i = 0; i < x.size(); ++i)
        ++hits[((std::uint64_t{x[i]} >> (32 - digits_x)) << digits_y) + (std::uint64_t{y[i]} >> (32 - digits_y))];
    return std::ranges::all_of(hits, [](std::uint32_t count) { return count == 1; });
}

// How many of their first digits are alike: 32 if all are.
inline int common_digits(std::uint32_t a, std::uint32_t b) {
    return std::countl_zero(a ^ b);
}
