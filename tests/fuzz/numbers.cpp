#include "tests/fuzz/numbers.h"

#include <cfloat>
#include <cmath>
#include <limits>

namespace fuzz {

double Numbers::any_magnitude() {
    const double mantissa = 1.0 + raw<std::uint8_t>() / 256.0;
    const double magnitude = std::clamp(mantissa * std::pow(10.0, below(37) - 18.0), 1e-18, 1e18);
    return one_in(2) ? -magnitude : magnitude;
}

double Numbers::anything() {
    static constexpr double special[] = {NAN,
                                         HUGE_VAL,
                                         -HUGE_VAL,
                                         DBL_TRUE_MIN,
                                         DBL_MAX,
                                         -DBL_MAX,
                                         FLT_TRUE_MIN,
                                         FLT_MAX,
                                         0.0,
                                         -1.0,
                                         1.0000000000000002e18,
                                         0.9999999999999999e-18};
    return one_in(4) ? raw<double>() : choice(special);
}

double Numbers::length() {
    static constexpr double ends[] = {
        0.0,         -0.0, 1e18,  -1e18,   1e-18,    -1e-18, 1.0,  -1.0,  0x1p-24,     1 - 0x1p-24, 1 + 0x1p-23,
        1 + 0x1p-52, 1e15, -1e15, 65536.0, -65536.0, 32.0,   1e-9, 1e-11, FLT_EPSILON, 16777217.0,  1e9};
    if (breaks_rule())
        return anything();
    switch (below(8)) {
    case 6:
        return any_magnitude();
    case 7:
        return choice(ends);
    default:
        return raw<std::int8_t>() / 16.0;
    }
}

double Numbers::positive_length() {
    if (breaks_rule())
        return anything();
    const double magnitude = std::abs(length());
    return magnitude > 0.0 ? magnitude : 1.0;
}

double Numbers::component() {
    if (!one_in(16))
        return length();
    const double any = raw<double>();
    return std::isfinite(any) ? any : 1.0;
}

double Numbers::share() {
    if (breaks_rule())
        return anything();
    static constexpr double ends[] = {0.0, 1.0, DBL_TRUE_MIN, 1.0 - 0x1p-53, 0x1p-30};
    return one_in(4) ? choice(ends) : raw<std::uint8_t>() / 255.0;
}

float Numbers::color() {
    if (breaks_rule())
        return static_cast<float>(anything());
    static constexpr float ends[] = {1e18F, 1e-18F, -0.0F, FLT_MIN, FLT_TRUE_MIN, 1e-30F};
    return one_in(4) ? choice(ends) : static_cast<float>(raw<std::uint8_t>()) / 64.0F;
}

float Numbers::glossiness() {
    if (breaks_rule())
        return static_cast<float>(anything());
    static constexpr float ends[] = {0.0F, 1e9F, -0.0F, FLT_MIN, 1.0F, 0x1p-24F, 1e6F, 16777216.0F, 1e-6F};
    return one_in(2) ? choice(ends) : static_cast<float>(raw<std::uint16_t>()) / 16.0F;
}

std::uint32_t Numbers::count(std::uint32_t end) {
    return breaks_rule() ? raw<std::uint32_t>() : below(end);
}

} // namespace fuzz
