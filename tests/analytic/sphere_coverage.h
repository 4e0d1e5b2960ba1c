// The share of each pixel that a sphere covers, exactly. Used by the tests of image sizes and of the operating range.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <numbers>
#include <utility>

namespace analytic {

// A sphere of radius 1 as a camera at the origin that looks along -z sees it on the image plane z = -1: where the angle
// to the centre c is at most the sphere's angular radius a, for the point (x, y)
//     (c_x x + c_y y - c_z)^2 >= cos^2 a |c|^2 (x^2 + y^2 + 1) = (|c|^2 - 1) (x^2 + y^2 + 1).
// In front of the camera that is an ellipse.
class SphereCoverage {
public:
    SphereCoverage(double x, double y, double z) : x_(x), y_(y), z_(z), tangent_(x * x + y * y + z * z - 1.0) {}

    // Area of the ellipse. As |det M| pi / |det M'|^(3/2) of the conic's matrix M and its part M' in x and y.
    double area() const {
        const double minor = tangent_ * (z_ * z_ - 1.0);
        return std::numbers::pi * tangent_ * tangent_ / std::pow(minor, 1.5);
    }

    // The part of the line of height y that is covered, of which both ends are the same if there is none.
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

    // Of the rectangle with these corners, by the midpoint rule over lines: off by about 3e-5 where the ellipse begins
    // or ends within it, else by less.
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
    double tangent_; // squared distance of the points where rays touch the sphere
};

} // namespace analytic
