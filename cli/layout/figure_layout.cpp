#include "cli/layout/figure_layout.h"

#include "cli/figure/box_lines.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <vector>

namespace cli {
namespace {

ViewExtents extents_of(const ViewFrame &frame, const Balls &balls, std::span<const glm::dvec3> points) {
    ViewExtents extents(frame);
    balls.each([&extents](const Ball &ball) { extents.add(ball); });
    for (const glm::dvec3 &point : points) {
        extents.add({point, 0.0});
    }
    return extents;
}

// Of the centres, along up and across it: a layer has 0, however large its balls are.
double relative_height(const Balls &balls, const Compass &compass) {
    ViewExtents extents({compass.right, compass.up, compass.front});
    balls.each([&extents](const Ball &ball) { extents.add({ball.center, 0.0}); });
    const double across = std::hypot(extents.width(), extents.depth());
    return across > 0.0 ? extents.height() / (across / std::sqrt(2.0)) : 1.0;
}

// A picture of the shape of what is seen, though not of a ribbon's: of 1024 x 768 pixels in all, sides being multiples
// of 8.
ImageSize shape_of(const ViewExtents &extents) {
    constexpr double pixel_count = 1024.0 * 768.0;
    constexpr double most_aspect = 2.0;
    const double aspect = std::clamp(extents.width() / extents.height(), 1.0 / most_aspect, most_aspect);
    const auto side = [](double pixels) { return 8 * static_cast<std::uint32_t>(std::lround(pixels / 8.0)); };
    return {side(std::sqrt(pixel_count * aspect)), side(std::sqrt(pixel_count / aspect))};
}

Bounds bounds_of(const Balls &balls, std::span<const glm::dvec3> points, const glm::dvec3 &center) {
    Bounds bounds{center, 0.0};
    const auto include = [&bounds](const Ball &ball) {
        const double reach = glm::length(ball.center - bounds.center) + ball.radius;
        bounds.radius = std::max(bounds.radius, reach);
    };
    balls.each(include);
    for (const glm::dvec3 &point : points) {
        include({point, 0.0});
    }
    return bounds;
}

// Below all, by a hair: a ball in the plane would meet it in one point, where roundings decide what is before.
Floor floor_below(const Balls &balls, std::span<const glm::dvec3> points, const Bounds &bounds,
                  const Compass &compass) {
    constexpr double gap = 1e-4;
    const ViewExtents extents = extents_of({compass.right, compass.front, compass.up}, balls, points);
    return {compass.up, extents.nearest() - gap * bounds.radius};
}

} // namespace

FigureLayout lay_out(const FigureLook &look, const std::optional<ImageSize> &size, const Balls &balls,
                     const std::optional<SimulationBox> &box) {
    std::vector<glm::dvec3> points;
    if (box) {
        const auto corners = corners_of(*box);
        points.assign(corners.begin(), corners.end());
    }
    const Compass compass = compass_of(look.up);
    const ViewFrame frame = view_frame(look.view, look.up, relative_height(balls, compass));
    const ViewExtents extents = extents_of(frame, balls, points);

    FigureLayout layout{};
    layout.size = size.value_or(shape_of(extents));
    const double aspect = static_cast<double>(layout.size.width) / layout.size.height;
    layout.camera = fit_camera(balls, points, extents, frame, look.projection, aspect);
    const Bounds bounds = bounds_of(balls, points, extents.center());
    std::optional<Floor> floor;
    if (look.has_floor) {
        floor = floor_below(balls, points, bounds, compass);
        if (glm::dot(floor->normal, layout.camera.position) <= floor->height) {
            throw std::invalid_argument("the camera is below it, by the view, and would see nothing else");
        }
    }
    layout.stage = make_stage(look.style, layout.camera, bounds, floor);
    return layout;
}

} // namespace cli
