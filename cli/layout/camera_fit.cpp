#include "cli/layout/camera_fit.h"

#include <algorithm>
#include <cmath>

namespace cli {

void ViewExtents::add(const Ball &ball) {
    const std::array<double, 3> place{glm::dot(frame_.right, ball.center), glm::dot(frame_.up, ball.center),
                                      glm::dot(frame_.forward, ball.center)};
    for (std::size_t i = 0; i < place.size(); ++i) {
        low_[i] = std::min(low_[i], place[i] - ball.radius);
        high_[i] = std::max(high_[i], place[i] + ball.radius);
    }
}

glm::dvec3 ViewExtents::center() const {
    const auto middle = [this](std::size_t i) { return 0.5 * low_[i] + 0.5 * high_[i]; };
    return middle(0) * frame_.right + middle(1) * frame_.up + middle(2) * frame_.forward;
}

PyramidFit::PyramidFit(const ViewFrame &frame, double horizontal_tangent, double vertical_tangent) :
    frame_(frame),
    pairs_{} {
    const auto pair = [](const glm::dvec3 &across, double tangent) {
        const double cosine = 1.0 / std::hypot(1.0, tangent);
        return Pair{across, tangent * cosine, cosine};
    };
    pairs_ = {pair(frame.right, horizontal_tangent), pair(frame.up, vertical_tangent)};
}

void PyramidFit::add(const Ball &ball) {
    const double along = glm::dot(frame_.forward, ball.center);
    for (Pair &pair : pairs_) {
        const double across = pair.cosine * glm::dot(pair.across, ball.center);
        pair.low = std::min(pair.low, across + pair.sine * along - ball.radius);
        pair.high = std::min(pair.high, -across + pair.sine * along - ball.radius);
    }
}

glm::dvec3 PyramidFit::apex() const {
    double along = std::numeric_limits<double>::infinity();
    glm::dvec3 apex{};
    for (const Pair &pair : pairs_) {
        along = std::min(along, (pair.low + pair.high) / (2.0 * pair.sine));
        apex += (pair.low - pair.high) / (2.0 * pair.cosine) * pair.across;
    }
    return apex + along * frame_.forward;
}

FittedCamera fit_camera(const Balls &balls, std::span<const glm::dvec3> points, const ViewExtents &extents,
                        const ViewFrame &frame, Projection projection, double aspect) {
    constexpr double used = 1.0 - 2.0 * figure_margin;
    const glm::dvec3 center = extents.center();
    FittedCamera camera{frame, {}, 0.0, projection, figure_vertical_fov, 0.0};
    if (projection == Projection::orthographic) {
        camera.view_height = std::max(extents.height(), extents.width() / aspect) / used;
        camera.target_distance = extents.depth() + camera.view_height; // before all balls
        camera.position = center - camera.target_distance * frame.forward;
    } else {
        const double tangent = used * std::tan(0.5 * camera.vertical_fov);
        PyramidFit fit(frame, tangent * aspect, tangent);
        balls.each([&fit](const Ball &ball) { fit.add(ball); });
        for (const glm::dvec3 &point : points) {
            fit.add({point, 0.0});
        }
        camera.position = fit.apex();
        camera.target_distance = glm::dot(frame.forward, center - camera.position);
    }
    return camera;
}

} // namespace cli
