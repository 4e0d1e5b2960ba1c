#include "cli/selftest/selftest.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstddef>
#include <limits>
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
    int scenes_without_noise = 0;
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
        if (scene.relative_std == 0.0) {
            ++scenes_without_noise;
            std::vector<float> radiance = right;
            radiance[100] *= 1.00001F;
            EXPECT_FALSE(scene.judge(radiance).passed()) << "every pixel counts";
        }
    }
    EXPECT_EQ(scenes_without_noise, 2);
    EXPECT_FALSE((cli::SelftestCheck{"function", "sine", std::nan(""), 2.5, "ulp", ""}).passed());
}

} // namespace
