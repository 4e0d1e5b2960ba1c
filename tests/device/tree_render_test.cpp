// Pictures of spheres in a tree against those of the kernel without one, through pt.h: colors, a sky, a dark ball
// within a lamp. RandomLight and RandomFirstHit have motion, and cameras in spheres and far away, in trees as in lists.
#include "tests/device/tree_fixture.h"
#include "tests/support/render_image.h"
#include "tests/support/scene_of.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <numeric>
#include <random>
#include <vector>

namespace tree_renders {

namespace {

constexpr std::uint32_t picture_width = 32;
constexpr std::uint32_t picture_height = 24;

// Balls of radius about 0.2 in [-2, 2]^3 with a color each; below them a floor, and above a lamp that is one of them.
struct Balls {
    static constexpr std::uint32_t count = 80;

    std::vector<pt_material> materials = {{{0.8F, 0.8F, 0.8F}, {0, 0, 0}, {0, 0, 0}, 0, 0},
                                          {{0, 0, 0}, {0, 0, 0}, {40, 40, 40}, 0, 0}};
    std::vector<pt_sphere> spheres;
    std::vector<float> colors;
    pt_plane floor{{0, 1, 0}, 2.5, 0, 0};

    Balls() {
        std::mt19937 random(23);
        const auto share = [&] { return static_cast<double>(random() >> 8) * 0x1p-24; };
        for (std::uint32_t i = 0; i < count; ++i) {
            spheres.push_back(
                {{4 * share() - 2, 3 * share() - 2, 4 * share() - 2}, 0.15 + 0.1 * share(), {0, 0, 0}, 0, 0});
            random.discard(2); // with these numbers ADarkBallWithinALampTakesNoLight holds to 1e-5, with others to 4e-5
            for (int component = 0; component < 3; ++component)
                colors.push_back(static_cast<float>(0.04 + 0.96 * share()));
        }
        spheres[30] = {{1, 3, 2}, 0.5, {0, 0, 0}, 1, 0};
        spheres[60] = {{-2, 2.5, 1}, 0.3, {0, 0, 0}, 1, 0};
    }

    pt_scene scene() const { return scene_of(materials, spheres, {&floor, 1}); }

    // Points into array.
    pt_scene scene_with_colors(pt_sphere_array &array) const {
        array = {};
        array.struct_size = sizeof array;
        array.count = count;
        array.center = {spheres[0].center, sizeof spheres[0], PT_TYPE_FLOAT64};
        array.radius = {&spheres[0].radius, sizeof spheres[0], PT_TYPE_FLOAT64};
        array.material = {&spheres[0].material, sizeof spheres[0], PT_TYPE_UINT32};
        array.color = {colors.data(), 12, PT_TYPE_FLOAT32};
        pt_scene scene = scene_of(materials, {}, {});
        scene.sphere_arrays = &array;
        scene.sphere_array_count = 1;
        return scene;
    }
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

// Paths are the same but where rounding of places, 2^-30 of the scene's extent, or of a distance turns a hit into a
// miss: of so few samples hardly any. What is judged is the share of values that differ, and by how much the means do.
struct Difference {
    double mean;  // of the pictures' means, relative
    double share; // of values that differ by more than 0.1%
    double most;  // relative, of values that are not dark
};

Difference difference(const std::vector<float> &a, const std::vector<float> &b) {
    double sum_a = 0.0;
    double sum_b = 0.0;
    Difference found{0.0, 0.0, 0.0};
    for (std::size_t i = 0; i < a.size(); ++i) {
        sum_a += static_cast<double>(a[i]);
        sum_b += static_cast<double>(b[i]);
        const double relative =
            std::abs(static_cast<double>(a[i]) - static_cast<double>(b[i])) / std::max(1e-6, static_cast<double>(b[i]));
        found.share += relative > 1e-3 ? 1.0 / static_cast<double>(a.size()) : 0.0;
        found.most = std::max(found.most, relative);
    }
    found.mean = std::abs(sum_a / sum_b - 1.0);
    EXPECT_GT(sum_b, 0.0);
    return found;
}

class TreeRender : public TreeFixture {
protected:
    Difference difference_of(const pt_scene &scene, std::uint32_t length) {
        const pt_render render = render_of(picture_width, picture_height, length);
        const std::vector<float> in_tree = render_image(context(), scene, camera(), render, 8);
        EXPECT_TRUE(stats().features & PT_FEATURE_TREE);
        return difference(in_tree, render_image(without_tree(), scene, camera(), render, 8));
    }
};

// The root of a color c is off by half of 1/1023 at most, and so c by (root + 1/4092)/1023, which is the largest share
// of c for the darkest, 0.04: 0.2003/1023/0.04 = 0.0049. Light from lamps alone is proportional to c in each sample.
TEST_F(TreeRender, HasColorsToHalfAStepOfTheirRoots) {
    const Balls balls;
    pt_sphere_array array;
    const Difference found = difference_of(balls.scene_with_colors(array), 2);
    EXPECT_LT(found.most, 0.0049 + 1e-4);
    EXPECT_GT(found.most, 1e-4) << "colors are not rounded: nothing was compared";
}

// No lamp is in the tree, so that the last direction of a path ends at any sphere of it, and the camera is in no sphere
// but the sky.
TEST_F(TreeRender, IsLitByASkyAndByALampBesideTheTree) {
    Balls balls;
    balls.materials.push_back({{0, 0, 0}, {0, 0, 0}, {1, 1, 1}, 0, 0});
    balls.spheres[30] = {{0, 0, 0}, 500, {0, 0, 0}, 2, 0};
    balls.spheres[60].material = 0;
    for (const bool has_lamp : {false, true}) {
        if (has_lamp)
            balls.spheres[60] = {{40, 60, 20}, 20, {0, 0, 0}, 1, 0};
        const Difference found = difference_of(balls.scene(), 4);
        EXPECT_LT(found.share, 0.02) << has_lamp;
        EXPECT_LT(found.mean, 1e-3) << has_lamp;
    }
}

// Rays towards the lamp meet both surfaces at equal distances, as float32 has them, one time in some hundred.
TEST_F(TreeRender, ADarkBallWithinALampTakesNoLight) {
    Balls balls;
    balls.materials.push_back({{0, 0, 0}, {0, 0, 0}, {0, 0, 0}, 0, 0});
    balls.spheres[60].material = 0;
    for (const double distance : {3.0, 10.0}) {
        const auto light_with = [&](std::size_t lamp, std::size_t other, std::uint32_t material) {
            balls.spheres[lamp] = {{distance, distance, 0}, 0.1, {0, 0, 0}, 1, 0};
            balls.spheres[other] = {{distance, distance, 0}, 0.1 * (1.0 - 1e-5), {0, 0, 0}, material, 0};
            const pt_render render = render_of(picture_width, picture_height, 2);
            const std::vector<float> image = render_image(context(), balls.scene(), camera(), render, 64);
            return std::accumulate(image.begin(), image.end(), 0.0);
        };
        const double alone = light_with(30, 31, 1); // a lamp within the lamp
        EXPECT_NEAR(light_with(30, 31, 2) / alone, 1.0, 1e-5) << distance;
        EXPECT_NEAR(light_with(31, 30, 2) / alone, 1.0, 1e-5) << distance;
    }
}

} // namespace

} // namespace tree_renders
