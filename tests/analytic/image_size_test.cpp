#include "tests/analytic/analytic_fixture.h"
#include "tests/analytic/judge.h"
#include "tests/analytic/sphere_coverage.h"
#include "tests/support/scene_of.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>
#include <string>

namespace {

using namespace analytic;

struct Shape {
    std::uint32_t width;
    std::uint32_t height;
    double window_height;
};

class ImageSize : public AnalyticFixture, public testing::WithParamInterface<Shape> {};

const SphereCoverage sphere_coverage(1, 0.5, -5);

Image render_sphere(const Shape &shape, double radius, const auto &image_of) {
    const pt_material material{{0, 0, 0}, {0, 0, 0}, {1, 1, 1}, 0, 0};
    const pt_sphere sphere{{1, 0.5, -4}, radius, {0, 0, 0}, 0, 0};
    const pt_scene scene = scene_of({&material, 1}, {&sphere, 1}, {});
    return image_of(scene, camera_at({0, 0, 1}, {0, 0, 0}, 2.0 * std::atan(0.5 * shape.window_height)));
}

std::uint32_t samples_for(const Shape &shape) {
    return std::bit_floor(std::clamp((1U << 22) / (shape.width * shape.height), 256U, 1U << 18));
}

double share_of(const Shape &shape, std::uint32_t x, std::uint32_t y) {
    const double size = shape.window_height / shape.height;
    const double left = (x - 0.5 * shape.width) * size;
    const double top = (0.5 * shape.height - y) * size;
    const auto [first, last] = sphere_coverage.chord(top - 0.5 * size);
    if (left > 0.5 || left + size < -0.1 || (first == last && std::abs(top) > 0.5 + size))
        return 0.0;
    return sphere_coverage.share(left, left + size, top - size, top);
}

// Full and empty pixels must be exact. The quadrature is exact to 1e-4.
std::uint32_t compare(const Image &image, const Shape &shape) {
    std::uint32_t found = 0;
    for (std::uint32_t y = 0; y < shape.height; ++y)
        for (std::uint32_t x = 0; x < shape.width; ++x) {
            const double share = share_of(shape, x, y);
            const double measured = image.red(x, y);
            const bool partly = share > 0.0 && share < 1.0 - 1e-9;
            const double tolerance =
                partly ? 1e-4 + share * noise_bound(std::sqrt((1.0 - share) / share), samples_for(shape)) : 0.0;
            found += std::abs(measured - (partly ? share : std::round(share))) > tolerance;
        }
    return found;
}

TEST_P(ImageSize, EveryPixelCoversItsShare) {
    const Shape &shape = GetParam();
    const auto render = [&](const pt_scene &scene, const pt_camera &camera) {
        return image_of(scene, camera, render_of(shape.width, shape.height, 1), samples_for(shape));
    };
    const Image image = render_sphere(shape, 1.0, render);
    EXPECT_EQ(compare(image, shape), 0U);
    // Negative control: 6% more area.
    EXPECT_GT(compare(render_sphere(shape, 1.03, render), shape), 0U);
}

TEST(ImageSizeClosedForm, SharesAddUpToTheArea) {
    EXPECT_NEAR(sphere_coverage.area(), 0.1342652736, 1e-9);
    const Shape shape{61, 37, 1.0};
    double sum = 0.0;
    for (std::uint32_t y = 0; y < shape.height; ++y)
        for (std::uint32_t x = 0; x < shape.width; ++x)
            sum += share_of(shape, x, y) / (37.0 * 37.0);
    EXPECT_NEAR(sum, sphere_coverage.area(), 1e-6);
}

INSTANTIATE_TEST_SUITE_P(Shapes, ImageSize,
                         testing::Values(Shape{1, 1, 1.0}, Shape{63, 1, 0.02}, Shape{64, 1, 0.02}, Shape{65, 1, 0.02},
                                         Shape{16384, 1, 2.0 / 16384}, Shape{1, 16384, 1.0}, Shape{61, 37, 1.0},
                                         Shape{127, 65, 1.0}),
                         [](const auto &param) {
                             return "Of" + std::to_string(param.param.width) + "x" + std::to_string(param.param.height);
                         });

} // namespace
