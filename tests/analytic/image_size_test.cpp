#include "tests/analytic/analytic_fixture.h"
#include "tests/support/render_image.h"
#include "tests/support/scene_of.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <random>
#include <string>
#include <vector>

namespace {

using namespace analytic;

struct Shape {
    std::uint32_t width;
    std::uint32_t height;
    double window_height;
};

// Planes that touch the unit sphere around the camera. Each has its own emission, and is the nearest in a convex part
// of the view.
class ImageSize : public AnalyticFixture, public testing::WithParamInterface<Shape> {
protected:
    ImageSize() {
        std::mt19937 engine(1);
        std::uniform_real_distribution<double> place(-1.0, 1.0);
        for (std::uint32_t i = 0; i < 24; ++i) {
            const float emission = static_cast<float>(i + 1) / 32.0F;
            materials_.push_back({{0, 0, 0}, {0, 0, 0}, {emission, emission, emission}, 0, 0});
            const double x = place(engine);
            const double y = place(engine);
            planes_.push_back({{-x, -y, 1.0}, std::hypot(x, y, 1.0), i, 0});
        }
    }

    std::vector<float> render() {
        const Shape &shape = GetParam();
        return render_image(context(), scene_of(materials_, {}, planes_),
                            camera_at({0, 0, 0}, {0, 0, -1}, 2.0 * std::atan(0.5 * shape.window_height)),
                            render_of(shape.width, shape.height, 1), 256);
    }

    // Pixels whose corners see one plane must be exact. Others have the bound 0.12, at least five standard errors.
    std::uint32_t wrong_pixels(const std::vector<float> &image, double shift) const {
        const Shape &shape = GetParam();
        std::uint32_t wrong = 0;
        for (std::uint32_t y = 0; y < shape.height; ++y)
            for (std::uint32_t x = 0; x < shape.width; ++x) {
                const double corner = emission_at(x + shift, y + shift);
                const bool exact = corner == emission_at(x + shift + 1, y + shift) &&
                                   corner == emission_at(x + shift, y + shift + 1) &&
                                   corner == emission_at(x + shift + 1, y + shift + 1);
                double mean = exact ? corner : 0.0;
                for (int i = 0; i < 32 * 32 && !exact; ++i)
                    mean += emission_at(x + shift + (i % 32 + 0.5) / 32, y + shift + (i / 32 + 0.5) / 32) / (32 * 32);
                const double found = image[3 * (std::size_t{y} * shape.width + x)];
                wrong += std::abs(found - mean) > (exact ? 0.0 : 0.12) ? 1 : 0;
            }
        return wrong;
    }

private:
    double emission_at(double x, double y) const {
        const Shape &shape = GetParam();
        const double size = shape.window_height / shape.height;
        const double across = (x - 0.5 * shape.width) * size;
        const double up = (0.5 * shape.height - y) * size;
        double steepest = 0.0;
        std::uint32_t nearest = 0;
        for (const pt_plane &plane : planes_)
            if (const double slope = (plane.normal[0] * across + plane.normal[1] * up - 1.0) / plane.offset;
                slope < steepest) {
                steepest = slope;
                nearest = plane.material;
            }
        return materials_[nearest].emission[0];
    }

    std::vector<pt_material> materials_;
    std::vector<pt_plane> planes_;
};

TEST_P(ImageSize, EveryPixelSeesItsPlanes) {
    const std::vector<float> image = render();
    EXPECT_EQ(wrong_pixels(image, 0.0), 0U);
    EXPECT_GT(wrong_pixels(image, 1.0), 0U) << "negative control: the next pixels";
}

INSTANTIATE_TEST_SUITE_P(Shapes, ImageSize,
                         testing::Values(Shape{1, 1, 1.0}, Shape{63, 1, 0.02}, Shape{64, 1, 0.02}, Shape{65, 1, 0.02},
                                         Shape{16384, 1, 2.0 / 16384}, Shape{1, 16384, 1.0}, Shape{61, 37, 1.0},
                                         Shape{127, 65, 1.0}),
                         [](const auto &param) {
                             return "Of" + std::to_string(param.param.width) + "x" + std::to_string(param.param.height);
                         });

} // namespace
