// Pictures of spheres in a tree against those of the kernel without one, through pt.h: colors, lamps, motion, a camera
// within a sphere and one far away, a sky.
#include "tests/device/tree_fixture.h"
#include "tests/support/render_image.h"
#include "tests/support/scene_of.h"
#include "tests/support/statistics.h"

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

    explicit Balls(double motion = 0.0) {
        std::mt19937 random(23);
        const auto share = [&] { return static_cast<double>(random() >> 8) * 0x1p-24; };
        for (std::uint32_t i = 0; i < count; ++i) {
            spheres.push_back({{4 * share() - 2, 3 * share() - 2, 4 * share() - 2},
                               0.15 + 0.1 * share(),
                               {motion * (share() - 0.5), motion * (share() - 0.5), 0},
                               0,
                               0});
            for (int component = 0; component < 3; ++component)
                colors.push_back(static_cast<float>(0.04 + 0.96 * share()));
        }
        spheres[30] = {{1, 3, 2}, 0.5, {motion, 0, 0}, 1, 0};
        spheres[60] = {{-2, 2.5, 1}, 0.3, {0, motion, 0}, 1, 0};
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

pt_camera camera_at(double x, double y, double z, double fov = 0.8) {
    pt_camera camera{};
    camera.struct_size = sizeof camera;
    camera.shutter_close = 1;
    camera.position[0] = x;
    camera.position[1] = y;
    camera.position[2] = z;
    camera.vertical_fov = fov;
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
    Difference difference_of(const pt_scene &scene, const pt_camera &camera, std::uint32_t length = 3) {
        const pt_render render = render_of(picture_width, picture_height, length);
        const std::vector<float> in_tree = render_image(context(), scene, camera, render, 8);
        EXPECT_TRUE(stats().features & PT_FEATURE_TREE);
        return difference(in_tree, render_image(without_tree(), scene, camera, render, 8));
    }
};

// The root of a color c is off by half of 1/1023 at most, and so c by (root + 1/4092)/1023, which is the largest share
// of c for the darkest, 0.04: 0.2003/1023/0.04 = 0.0049. Light from lamps alone is proportional to c in each sample.
TEST_F(TreeRender, HasColorsToHalfAStepOfTheirRoots) {
    const Balls balls;
    pt_sphere_array array;
    const Difference found = difference_of(balls.scene_with_colors(array), camera_at(0, 1, 6), 2);
    EXPECT_LT(found.most, 0.0049 + 1e-4);
    EXPECT_GT(found.most, 1e-4) << "colors are not rounded: nothing was compared";
}

TEST_F(TreeRender, MovesSpheresWithTheShutter) {
    const Balls balls(1.0);
    const double shutters[][2] = {{0, 1}, {0.3, 0.6}, {0.5, 0.500001}};
    for (const auto &[open, close] : shutters) {
        pt_camera camera = camera_at(0, 1, 6);
        camera.shutter_open = open;
        camera.shutter_close = close;
        const Difference found = difference_of(balls.scene(), camera);
        EXPECT_LT(found.share, 0.02) << open << " to " << close;
        EXPECT_LT(found.mean, 1e-3) << open << " to " << close;
    }
    // Where nothing moves any more the other kernel takes no numbers for the time, so that its noise is another.
    pt_camera frozen = camera_at(0, 1, 6);
    frozen.shutter_open = frozen.shutter_close = 0.5;
    EXPECT_LT(difference_of(balls.scene(), frozen).mean, 0.01);
}

TEST_F(TreeRender, IsSeenFromWithinASphereAndFromFarAway) {
    Balls balls;
    const pt_sphere &about = balls.spheres[7];
    // Within a ball all is dark but for a lamp that is in it, too.
    balls.spheres[8] = about;
    balls.spheres[8].radius = 0.05;
    balls.spheres[8].material = 1;
    const pt_camera within = camera_at(about.center[0] + 0.1, about.center[1], about.center[2]);
    EXPECT_LT(difference_of(balls.scene(), within).mean, 1e-3);
    balls.spheres[8].center[0] += 10; // the lamp is not seen any more, but there is a path tracer's whole scene
    pt_scene scene = balls.scene();
    scene.plane_count = 0;
    const Difference far = difference_of(scene, camera_at(0, 4e5, 4e6, 1.2e-6));
    EXPECT_LT(far.share, 0.02);
    EXPECT_LT(far.mean, 1e-3);
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
        for (const std::uint32_t length : {2U, 4U}) {
            const Difference found = difference_of(balls.scene(), camera_at(0, 1, 6), length);
            EXPECT_LT(found.share, 0.02) << length;
            EXPECT_LT(found.mean, 1e-3) << length;
        }
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
            const std::vector<float> image = render_image(context(), balls.scene(), camera_at(0, 1, 6), render, 64);
            return std::accumulate(image.begin(), image.end(), 0.0);
        };
        const double alone = light_with(30, 31, 1); // a lamp within the lamp
        EXPECT_NEAR(light_with(30, 31, 2) / alone, 1.0, 1e-5) << distance;
        EXPECT_NEAR(light_with(31, 30, 2) / alone, 1.0, 1e-5) << distance;
    }
}

// Independent samples: means of 24 pictures each, by their standard errors. One false alarm in a million.
TEST_F(TreeRender, HasTheLightOfItsLamps) {
    const Balls balls;
    const auto means = [&](pt_context *on, std::uint64_t first_seed, float brighter) {
        Balls lit = balls;
        for (float &component : lit.materials[1].emission)
            component *= brighter;
        std::vector<double> values;
        for (std::uint64_t i = 0; i < 24; ++i) {
            pt_render render = render_of(picture_width, picture_height, 3);
            render.seed = first_seed + i;
            double sum = 0.0;
            for (const float value : render_image(on, lit.scene(), camera_at(0, 1, 6), render, 32))
                sum += static_cast<double>(value);
            values.push_back(sum);
        }
        return statistics::moments(values);
    };
    const statistics::Moments without = means(without_tree(), 1000, 1.0F);
    const auto deviation = [&](const statistics::Moments &in_tree) {
        return std::abs(in_tree.mean - without.mean) / std::sqrt((in_tree.variance + without.variance) / 24.0);
    };
    const double allowed = statistics::normal_quantile(0.5e-6) * 1.25; // for 46 degrees of freedom
    EXPECT_LT(deviation(means(context(), 1, 1.0F)), allowed);
    EXPECT_GT(deviation(means(context(), 1, 1.03F)), allowed) << "a lamp that is brighter by 3% is not noticed";
}

} // namespace

} // namespace tree_renders
