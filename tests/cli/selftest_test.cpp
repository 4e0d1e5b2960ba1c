#include "cli/selftest/selftest.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstddef>
#include <limits>
#include <numbers>
#include <vector>

namespace {

using cli::SelftestScene;

std::vector<float> image_of(const SelftestScene &scene, double radiance) {
    return std::vector<float>(std::size_t{3} * scene.scene.render.width * scene.scene.render.height,
                              static_cast<float>(radiance));
}

std::vector<SelftestScene> all_scenes() {
    std::vector<SelftestScene> scenes = cli::selftest_scenes();
    for (const SelftestScene &scene : cli::weight_scenes())
        scenes.push_back(scene);
    return scenes;
}

TEST(SelftestScene, WrongImagesFail) {
    constexpr double infinity = std::numeric_limits<double>::infinity();
    for (const SelftestScene &scene : all_scenes()) {
        SCOPED_TRACE(scene.name);
        EXPECT_LT(scene.bound(), 0.02) << "judges too mildly";
        const std::vector<float> right = image_of(scene, scene.expected);
        for (const double factor :
             {1.0 + 1.2 * scene.bound() + 0x1p-22, 1.0 - 1.2 * scene.bound() - 0x1p-22, 0.0, -1.0})
            EXPECT_FALSE(scene.judge(image_of(scene, scene.expected * factor)).passed()) << factor;
        for (const float wrong : {std::numeric_limits<float>::quiet_NaN(), std::numeric_limits<float>::infinity()}) {
            for (const std::size_t place : {std::size_t{0}, right.size() - 1}) {
                std::vector<float> radiance = right;
                radiance[place] = wrong;
                EXPECT_EQ(scene.judge(radiance).error, infinity);
            }
        }
        for (std::size_t channel = 0; channel < 3; ++channel) {
            std::vector<float> radiance = right;
            for (std::size_t i = channel; i < radiance.size(); i += 3)
                radiance[i] *= 1.03F;
            EXPECT_FALSE(scene.judge(radiance).passed()) << channel;
        }
    }
    EXPECT_FALSE((cli::SelftestCheck{"function", "sine", std::nan(""), 2.5, "ulp", ""}).passed());
}

TEST(SelftestScene, WithoutNoiseEveryPixelCounts) {
    int scene_count = 0;
    for (const SelftestScene &scene : cli::selftest_scenes()) {
        if (scene.relative_std == 0.0) {
            ++scene_count;
            std::vector<float> radiance = image_of(scene, scene.expected);
            radiance[100] *= 1.00001F;
            EXPECT_FALSE(scene.judge(radiance).passed()) << scene.name;
        }
    }
    EXPECT_EQ(scene_count, 2);
}

TEST(SelftestScene, RecedingLampByQuadrature) {
    const SelftestScene scene = cli::selftest_scenes().back();
    ASSERT_EQ(scene.name, "receding lamp");
    const double side = 2.0 * std::tan(0.5 * scene.scene.camera.vertical_fov);
    constexpr int steps = 10000;
    double sum = 0.0;
    for (int i = 0; i < steps; ++i) {
        const double z = scene.scene.spheres[0].center[2] + (i + 0.5) / steps * scene.scene.spheres[0].motion[2];
        sum += std::numbers::pi / (z * z - 1.0) / (side * side);
    }
    EXPECT_NEAR(scene.expected, sum / steps, 1e-8);
}

} // namespace
