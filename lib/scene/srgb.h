// Decodes sRGB bytes (IEC 61966-2-1). The table is made at compile time, so that bits do not depend on a mathematics
// library.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

namespace pt {

namespace srgb {

// x^(1/5) for x in (0, 1], by Newton's method from above.
constexpr double fifth_root(double x) {
    double root = 1.0;
    for (;;) {
        const double fourth = root * root * root * root;
        const double next = root - (root * fourth - x) / (5.0 * fourth);
        if (next >= root)
            return root;
        root = next;
    }
}

constexpr double decoded(double encoded) {
    if (encoded <= 0.04045)
        return encoded / 12.92;
    const double base = (encoded + 0.055) / 1.055;
    const double square = base * base;
    return square * fifth_root(square); // base^2.4
}

constexpr std::array<float, 256> decoded_bytes() {
    std::array<float, 256> table{};
    for (std::size_t i = 0; i < table.size(); ++i)
        table[i] = static_cast<float>(decoded(static_cast<double>(i) / 255.0));
    return table;
}

inline constexpr std::array<float, 256> table = decoded_bytes();

} // namespace srgb

constexpr float linear_from_srgb(std::uint8_t byte) {
    return srgb::table[byte];
}

} // namespace pt
