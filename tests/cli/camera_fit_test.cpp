// Tests of cli/layout/camera_fit: all of every ball is in the picture, and no nearer camera would have it so.
#include "cli/layout/camera_fit.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>
#include <vector>

namespace {

using cli::Ball;
using cli::Balls;
using cli::FittedCamera;
using cli::Projection;
using cli::ViewFrame;

// A few roundings of coordinates that are up to a hundred times as large as the distances here.
constexpr double rounding = 1e-12;

struct Cloud {
    std::vector<double> centers;
    std::vector<float> radii;
    std::vector<glm::dvec3> points;

    Balls balls() const {
        Balls balls;
        balls.add(centers, radii);
        return balls;
    }
};

// Balls and points, of which some are far from the origin; one ball may be much larger than the others.
Cloud random_cloud(std::mt19937_64 &random) {
    std::uniform_real_distribution<double> share(0.0, 1.0);
    Cloud cloud;
    const glm::dvec3 shift{20.0 * share(random) - 10.0, 20.0 * share(random) - 10.0, 20.0 * share(random) - 10.0};
    const glm::dvec3 stretch{share(random), share(random), share(random)};
    const std::size_t count = 1 + random() % 12;
    for (std::size_t i = 0; i < count; ++i) {
        for (glm::length_t axis = 0; axis < 3; ++axis) {
            cloud.centers.push_back(shift[axis] + stretch[axis] * share(random));
        }
        cloud.radii.push_back(static_cast<float>(0.5 * std::pow(share(random), 4.0) + 1e-3));
    }
    cloud.points.resize(random() % 4);
    for (glm::dvec3 &point : cloud.points) {
        point = shift + share(random) * stretch;
    }
    return cloud;
}

ViewFrame random_frame(std::mt19937_64 &random) {
    std::normal_distribution<double> normal;
    const glm::dvec3 forward = glm::normalize(glm::dvec3{normal(random), normal(random), normal(random)});
    const glm::dvec3 right =
        glm::normalize(glm::cross(forward, glm::dvec3{normal(random), normal(random), normal(random)}));
    return {right, glm::cross(right, forward), forward};
}

FittedCamera fitted(const Cloud &cloud, const ViewFrame &frame, Projection projection, double aspect) {
    cli::ViewExtents extents(frame);
    cloud.balls().each([&extents](const Ball &ball) { extents.add(ball); });
    for (const glm::dvec3 &point : cloud.points) {
        extents.add({point, 0.0});
    }
    return fit_camera(cloud.balls(), cloud.points, extents, frame, projection, aspect);
}

// How far from the middle of the picture a ball's outline reaches, to each side: 1 is the side of the picture. In a
// perspective the outline is a cone about the center's direction; in the plane of `across` and forward, rays that touch
// the ball make the angle asin(r / d) with it. The fit is found in another way, by signed distances to planes.
double reach(const FittedCamera &camera, const Ball &ball, const glm::dvec3 &across, double half_extent) {
    const glm::dvec3 way = ball.center - camera.position;
    const double aside = glm::dot(across, way);
    if (camera.projection == Projection::orthographic) {
        return (std::abs(aside) + ball.radius) / half_extent;
    }
    const double along = glm::dot(camera.frame.forward, way);
    const double distance = std::hypot(aside, along);
    if (distance <= ball.radius) {
        return INFINITY;
    }
    const double angle = std::atan2(std::abs(aside), along) + std::asin(ball.radius / distance);
    return angle < std::asin(1.0) ? std::tan(angle) / half_extent : INFINITY;
}

// The largest over all that has to be seen.
double largest_reach(const Cloud &cloud, const FittedCamera &camera, double aspect) {
    const double half_height =
        camera.projection == Projection::orthographic ? 0.5 * camera.view_height : std::tan(0.5 * camera.vertical_fov);
    double largest = 0.0;
    const auto include = [&](const Ball &ball) {
        largest = std::max({largest, reach(camera, ball, camera.frame.right, half_height * aspect),
                            reach(camera, ball, camera.frame.up, half_height)});
    };
    cloud.balls().each(include);
    for (const glm::dvec3 &point : cloud.points) {
        include({point, 0.0});
    }
    return largest;
}

// What the margin leaves, of half a picture.
constexpr double used = 0.94;

class CameraFit : public testing::TestWithParam<Projection> {};

TEST_P(CameraFit, ShowsAllAndIsTight) {
    std::mt19937_64 random(20080917);
    for (int i = 0; i < 2000; ++i) {
        const Cloud cloud = random_cloud(random);
        const ViewFrame frame = random_frame(random);
        const double aspect = std::exp2(std::uniform_real_distribution<double>(-2.0, 2.0)(random));
        FittedCamera camera = fitted(cloud, frame, GetParam(), aspect);
        ASSERT_NEAR(largest_reach(cloud, camera, aspect), used, rounding * 100.0) << "cloud " << i;

        if (GetParam() == Projection::perspective) {
            camera.position += 0.01 * camera.target_distance * frame.forward;
        } else {
            camera.view_height *= 0.99;
        }
        ASSERT_GT(largest_reach(cloud, camera, aspect), used * 1.0001) << "cloud " << i;
    }
}

INSTANTIATE_TEST_SUITE_P(, CameraFit, testing::Values(Projection::perspective, Projection::orthographic),
                         [](const testing::TestParamInfo<Projection> &projection) {
                             return projection.param == Projection::perspective ? "Perspective" : "Orthographic";
                         });

constexpr ViewFrame along_z{{1.0, 0.0, 0.0}, {0.0, 1.0, 0.0}, {0.0, 0.0, -1.0}};

// The sides touch the ball: sin(half angle) = r / d, with the angle of the shorter side.
TEST(CameraFitOfOneBall, PerspectiveIsExact) {
    const Cloud ball{{3.0, -2.0, 5.0}, {0.5}, {}};
    for (const double aspect : {0.5, 1.0, 2.0}) {
        const FittedCamera camera = fitted(ball, along_z, Projection::perspective, aspect);
        const double half_angle = std::atan(used * std::tan(0.5 * cli::figure_vertical_fov) * std::min(aspect, 1.0));
        const double distance = 0.5 / std::sin(half_angle);
        EXPECT_NEAR(camera.position[0], 3.0, rounding);
        EXPECT_NEAR(camera.position[1], -2.0, rounding);
        EXPECT_NEAR(camera.position[2], 5.0 + distance, rounding * 10.0);
        EXPECT_NEAR(camera.target_distance, distance, rounding * 10.0);
    }
}

TEST(CameraFitOfOneBall, OrthographicIsExact) {
    const Cloud ball{{3.0, -2.0, 5.0}, {0.5}, {}};
    for (const double aspect : {0.5, 1.0, 2.0}) {
        const FittedCamera camera = fitted(ball, along_z, Projection::orthographic, aspect);
        EXPECT_NEAR(camera.view_height, 1.0 / used / std::min(aspect, 1.0), rounding);
        EXPECT_NEAR(camera.position[0], 3.0, rounding);
        EXPECT_NEAR(camera.position[1], -2.0, rounding);
        EXPECT_GT(camera.position[2], 5.5); // before the ball, as what is behind it is not seen
    }
}

} // namespace
