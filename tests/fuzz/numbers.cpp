#include "tests/fuzz/numbers.h"

#include <algorithm>
#include <cfloat>
#include <cmath>
#include <limits>
#include <numbers>

namespace fuzz {

double Numbers::ordinary() {
    return bytes_.raw<std::int8_t>() / 16.0;
}

double Numbers::any_magnitude() {
    const double mantissa = 1.0 + bytes_.raw<std::uint8_t>() / 256.0;
    const double magnitude = std::clamp(mantissa * std::pow(10.0, bytes_.below(37) - 18.0), 1e-18, 1e18);
    return bytes_.one_in(2) ? -magnitude : magnitude;
}

double Numbers::boundary() {
    static constexpr double ends[] = {
        0.0,         -0.0, 1e18,  -1e18,   1e-18,    -1e-18, 1.0,  -1.0,  0x1p-24,     1 - 0x1p-24, 1 + 0x1p-23,
        1 + 0x1p-52, 1e15, -1e15, 65536.0, -65536.0, 32.0,   1e-9, 1e-11, FLT_EPSILON, 16777217.0,  1e9};
    return bytes_.choice(ends);
}

double Numbers::anything() {
    using Limits = std::numeric_limits<double>;
    static constexpr double special[] = {Limits::quiet_NaN(),
                                         -Limits::quiet_NaN(),
                                         Limits::infinity(),
                                         -Limits::infinity(),
                                         Limits::denorm_min(),
                                         -Limits::denorm_min(),
                                         Limits::min(),
                                         Limits::max(),
                                         -Limits::max(),
                                         std::numeric_limits<float>::denorm_min(),
                                         std::numeric_limits<float>::min(),
                                         std::numeric_limits<float>::max(),
                                         0.0,
                                         -1.0,
                                         1.0000000000000002e18,
                                         0.9999999999999999e-18,
                                         std::numbers::pi,
                                         0.9999999999999999e-8};
    return bytes_.one_in(4) ? bytes_.raw<double>() : bytes_.choice(special);
}

double Numbers::length() {
    if (breaks_rule())
        return anything();
    switch (bytes_.below(8)) {
    case 6:
        return any_magnitude();
    case 7:
        return boundary();
    default:
        return ordinary();
    }
}

double Numbers::positive_length() {
    if (breaks_rule())
        return anything();
    const double magnitude = std::abs(length());
    return magnitude > 0.0 ? magnitude : 1.0;
}

double Numbers::component() {
    if (breaks_rule())
        return anything();
    if (!bytes_.one_in(16))
        return length();
    const double any = bytes_.raw<double>();
    return std::isfinite(any) ? any : 1.0;
}

double Numbers::share() {
    if (breaks_rule())
        return anything();
    static constexpr double ends[] = {0.0, 1.0, std::numeric_limits<double>::denorm_min(), 1.0 - 0x1p-53, 0x1p-30};
    return bytes_.one_in(4) ? bytes_.choice(ends) : bytes_.raw<std::uint8_t>() / 255.0;
}

double Numbers::field_of_view() {
    if (breaks_rule())
        return anything();
    static constexpr double ends[] = {1e-8, 3.1415926535897927, 3.14, 1e-4};
    return bytes_.one_in(4) ? bytes_.choice(ends) : (1 + bytes_.below(255)) / 256.0 * std::numbers::pi;
}

float Numbers::color() {
    if (breaks_rule())
        return static_cast<float>(anything());
    static constexpr float ends[] = {1e18F, 1e-18F, -0.0F, FLT_MIN, std::numeric_limits<float>::denorm_min(), 1e-30F};
    return bytes_.one_in(4) ? bytes_.choice(ends) : static_cast<float>(bytes_.raw<std::uint8_t>()) / 64.0F;
}

float Numbers::glossiness() {
    if (breaks_rule())
        return static_cast<float>(anything());
    static constexpr float ends[] = {0.0F, 1e9F, -0.0F, FLT_MIN, 1.0F, 0x1p-24F, 1e6F, 16777216.0F, 1e-6F};
    return bytes_.one_in(2) ? bytes_.choice(ends) : static_cast<float>(bytes_.raw<std::uint16_t>()) / 16.0F;
}

std::uint32_t Numbers::count(std::uint32_t end) {
    if (breaks_rule())
        return bytes_.raw<std::uint32_t>();
    return bytes_.below(end);
}

} // namespace fuzz
