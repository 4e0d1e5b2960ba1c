#include "tests/accuracy/comparison.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>
#include <limits>

namespace accuracy {

namespace {

constexpr Real control_shift = 1.01L;

} // namespace

void Comparison::add(Real value, Real exact, Real bound, const std::vector<float> &input) {
    add_error(std::abs(value - exact), std::abs(value - (exact + control_shift * bound)), bound, input);
}

void Comparison::add(const glm::vec3 &value, const Direction &exact, Real bound, const std::vector<float> &input) {
    const Direction shift = control_shift * bound * Direction(0.48L, -0.6L, 0.64L);
    add_error(glm::length(Direction(value) - exact), glm::length(Direction(value) - exact - shift), bound, input);
}

void Comparison::add_error(Real error, Real error_of_control, Real bound, const std::vector<float> &input) {
    ++count_;
    const Real share = std::isfinite(error) ? error / bound : std::numeric_limits<Real>::infinity();
    largest_error_ = std::fmax(largest_error_, error);
    worst_share_of_control_ = std::fmax(worst_share_of_control_, error_of_control / bound);
    if (share <= worst_share_)
        return;
    worst_share_ = share;
    worst_error_ = error;
    worst_bound_ = bound;
    worst_input_ = input;
}

void Comparison::finish() const {
    std::printf("accuracy: %-28s %6zu inputs, largest error %8.2Lg, worst %8.2Lg of %8.2Lg %s at", function_.c_str(),
                count_, largest_error_, worst_error_, worst_bound_, unit_.c_str());
    for (const float number : worst_input_)
        std::printf(" %.9g", static_cast<double>(number));
    std::printf("\n");
    EXPECT_GT(count_, 0U) << function_;
    EXPECT_LE(worst_share_, 1) << function_ << " is beyond its bound";
    EXPECT_GT(worst_share_of_control_, 1) << function_ << ": exact values off by 1.01 bounds must be seen";
}

void add_in_ulp(Comparison &comparison, float value, Real exact, Real bound_in_ulp, Real negligible,
                const std::vector<float> &input) {
    if (std::abs(exact) < negligible) {
        EXPECT_LE(std::abs(value), 2 * negligible) << "for " << static_cast<double>(exact);
        return;
    }
    const int exponent = 23 - std::ilogb(exact);
    comparison.add(std::ldexp(Real{value}, exponent), std::ldexp(exact, exponent), bound_in_ulp, input);
}

} // namespace accuracy
