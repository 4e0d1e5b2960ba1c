// Where points of the world are in the picture.
#pragma once

#include "cli/layout/camera_fit.h"

#include <cstdint>

namespace cli {

struct ScreenPoint {
    double x;     // pixels, from the left side
    double y;     // pixels, from the top
    double depth; // along the view, as PT_QUANTITY_DEPTH has it
};

class Screen {
public:
    Screen(const FittedCamera &camera, std::uint32_t width, std::uint32_t height) :
        camera_(camera),
        width_(width),
        height_(height) {}

    // For a perspective the point has to be before the camera.
    ScreenPoint project(const glm::dvec3 &point) const {
        const glm::dvec3 way = point - camera_.position;
        const double depth = glm::dot(camera_.frame.forward, way);
        const double scale = pixels_per_length(depth);
        return {0.5 * width_ + scale * glm::dot(camera_.frame.right, way),
                0.5 * height_ - scale * glm::dot(camera_.frame.up, way), depth};
    }

    // Across the view, at this depth.
    double pixels_per_length(double depth) const {
        return camera_.projection == Projection::orthographic
                   ? height_ / camera_.view_height
                   : 0.5 * height_ / (depth * std::tan(0.5 * camera_.vertical_fov));
    }

    bool is_perspective() const { return camera_.projection == Projection::perspective; }

private:
    FittedCamera camera_;
    double width_;
    double height_;
};

} // namespace cli
