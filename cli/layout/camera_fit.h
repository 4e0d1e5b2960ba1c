// Fits the camera to balls: the tightest frame, for a direction of view, that shows all of each.
#pragma once

#include "cli/layout/balls.h"
#include "cli/layout/view_frame.h"

#include <limits>
#include <numbers>

namespace cli {

enum class Projection { perspective, orthographic };

struct FittedCamera {
    ViewFrame frame;
    glm::dvec3 position;
    double target_distance; // from the position along the view to the middle of what is seen
    Projection projection;
    double vertical_fov; // full angle in radians, of the perspective
    double view_height;  // full height of what an orthographic camera sees
};

// Extents of balls along the axes of a view; empty at first.
class ViewExtents {
public:
    explicit ViewExtents(const ViewFrame &frame) : frame_(frame) {}

    void add(const Ball &ball);

    double width() const { return high_[0] - low_[0]; }
    double height() const { return high_[1] - low_[1]; }
    double depth() const { return high_[2] - low_[2]; }
    double nearest() const { return low_[2]; } // along the view
    double farthest() const { return high_[2]; }
    glm::dvec3 center() const; // in the world

private:
    static constexpr double infinity = std::numeric_limits<double>::infinity();

    ViewFrame frame_;
    std::array<double, 3> low_{infinity, infinity, infinity}; // right, up, forward
    std::array<double, 3> high_{-infinity, -infinity, -infinity};
};

// A pyramid of view with a fixed direction, whose apex goes as near as the balls allow.
//
// A ball is seen as a whole if it is on the inner side of the four planes through the pinhole p and the sides of the
// picture: dot(n, c - p) >= r for the inward unit normal n of each. Over all balls that is dot(n, p) <= s with s the
// least dot(n, c) - r: four numbers are all that has to be kept of them. With half of the horizontal angle a, the
// normals of the left and the right plane are cos(a) right + sin(a) forward and -cos(a) right + sin(a) forward. Their
// sum bounds how far forward p may be, dot(forward, p) <= (s_left + s_right) / (2 sin a), and the same holds of the
// other pair; the smaller bound is met. What is left of the freedom sideways puts p in the middle between the two
// planes of a pair: dot(right, p) = (s_left - s_right) / (2 cos a).
class PyramidFit {
public:
    // The sines and cosines are those of the half angles, whose tangents are given.
    PyramidFit(const ViewFrame &frame, double horizontal_tangent, double vertical_tangent);

    void add(const Ball &ball);
    glm::dvec3 apex() const;

private:
    struct Pair { // left and right, or bottom and top
        glm::dvec3 across;
        double sine;
        double cosine;
        double low = std::numeric_limits<double>::infinity(); // s above
        double high = std::numeric_limits<double>::infinity();
    };

    ViewFrame frame_;
    std::array<Pair, 2> pairs_;
};

// The full vertical angle of the perspective: narrow, as portraits are taken, since wide ones make balls at the sides
// of the picture look like eggs.
inline constexpr double figure_vertical_fov = 20.0 * std::numbers::pi / 180.0;

// The share of the picture that stays free at the sides: by taste, as is the angle.
inline constexpr double figure_margin = 0.03;

// points: what has to be seen as well, like the corners of a box. extents: of all of them. There must be one at least.
FittedCamera fit_camera(const Balls &balls, std::span<const glm::dvec3> points, const ViewExtents &extents,
                        const ViewFrame &frame, Projection projection, double aspect);

} // namespace cli
