#include "cli/selftest/selftest.h"

#include <gtest/gtest.h>

#include <algorithm>
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
    for (const SelftestScene &scene : all_scenes()) {
        for (const double factor :
             {1.0 + 1.2 * scene.bound() + 0x1p-22, 1.0 - 1.2 * scene.bound() - 0x1p-22, 0.0, -1.0})
            EXPECT_FALSE(scene.judge(image_of(scene, scene.expected * factor)).passed()) << scene.name << factor;
        EXPECT_LT(scene.bound(), 0.02) << scene.name << " judges too mildly";
    }
}

TEST(SelftestScene, ASingleNumberThatIsNotFiniteFails) {
    for (const SelftestScene &scene : all_scenes()) {
        for (const float wrong : {std::numeric_limits<float>::quiet_NaN(), std::numeric_limits<float>::infinity()}) {
            for (const std::size_t place : {std::size_t{0}, image_of(scene, 0.0).size() - 1}) {
                std::vector<float> radiance = image_of(scene, scene.expected);
                radiance[place] = wrong;
                const cli::SelftestCheck check = scene.judge(radiance);
                EXPECT_FALSE(check.passed()) << scene.name;
                EXPECT_EQ(check.error, std::numeric_limits<double>::infinity());
            }
        }
    }
}

TEST(SelftestScene, EveryChannelCounts) {
    for (const SelftestScene &scene : cli::selftest_scenes()) {
        for (std::size_t channel = 0; channel < 3; ++channel) {
            std::vector<float> radiance = image_of(scene, scene.expected);
            for (std::size_t i = channel; i < radiance.size(); i += 3)
                radiance[i] *= 1.03F;
            EXPECT_FALSE(scene.judge(radiance).passed()) << scene.name;
        }
    }
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

// Integrates light that is found by one sample of a lamp and by some directions. The power heuristic gives the weights.
class TwoWays {
public:
    explicit TwoWays(int directions) : directions_(directions) {}

    // Adds a part of the integral. `sample_density` belongs to the lamp's sample, and `direction_density` to one
    // direction.
    void add(double part, double measure, double sample_density, double direction_density) {
        const double a = sample_density;
        const double b = directions_ * direction_density;
        const double weight = a * a / (a * a + b * b);
        const double value = part / measure;
        of_sample_ += weight * part;
        of_directions_ += (1.0 - weight) * part;
        squares_ += (std::pow(weight * value / a, 2) * a +
                     directions_ * std::pow((1.0 - weight) * value / b, 2) * direction_density) *
                    measure;
    }

    double all() const { return of_sample_ + of_directions_; }
    double least() const { return std::min(of_sample_, of_directions_); }
    double deviation() const {
        return std::sqrt(squares_ - of_sample_ * of_sample_ - of_directions_ * of_directions_ / directions_);
    }

private:
    int directions_;
    double of_sample_ = 0.0;
    double of_directions_ = 0.0;
    double squares_ = 0.0;
};

constexpr double pi = std::numbers::pi;

// Each sample chooses one of `count` lamps of radiance 1. `polar` is the angle of each lamp's center to the normal.
// `sine` is the sine of the angular radius.
TwoWays light_of_lamps(int count, double polar, double sine, int directions) {
    constexpr int steps = 400;
    const double cap = 1.0 - std::sqrt(1.0 - sine * sine);
    TwoWays light(directions);
    for (int i = 0; i < steps; ++i) {
        const double along = 1.0 - cap * (i + 0.5) / steps;
        for (int k = 0; k < steps; ++k) {
            const double across = std::sqrt(1.0 - along * along) * std::cos(2.0 * pi * (k + 0.5) / steps);
            const double cosine = std::cos(polar) * along + std::sin(polar) * across;
            const double measure = count * 2.0 * pi * cap / (steps * steps);
            light.add(cosine / pi * measure, measure, 1.0 / (count * 2.0 * pi * cap), cosine / pi);
        }
    }
    return light;
}

// A lamp of power 1 lights a ceiling of albedo 20 at height 6.5 above it. The integral runs over the fraction of the
// lamp's directions.
TwoWays light_of_glow() {
    constexpr int steps = 1000000;
    constexpr double height = 6.5;
    TwoWays light(2);
    for (int i = 0; i < steps; ++i) {
        const double squared_way = steps / (i + 0.5); // squared distance from the lamp
        const double squared_distance = squared_way - 1.0 + height * height;
        const double density = 1.0 / (pi * squared_way * squared_way);
        const double form = height * height / (pi * squared_distance * squared_distance);
        const double measure = 1.0 / (steps * density);
        light.add(20.0 / std::pow(squared_way, 1.5) * form * measure, measure, density, form);
    }
    return light;
}

TEST(SelftestScene, AWeightThatIsWrongByTwoPercentMovesTheMeanByTwiceTheBound) {
    const std::vector<SelftestScene> scenes = cli::weight_scenes();
    ASSERT_EQ(scenes.size(), 3U);
    struct Light {
        TwoWays ways;
        double factor;
        double other;
    };
    const std::vector<Light> lights{{light_of_lamps(1, 0.0, 0.5, 4), 4.0, 0.0},
                                    {light_of_lamps(5, pi * 50.0 / 180.0, 0.42, 1), 1.0, 0.0},
                                    {light_of_glow(), 1.0, 1.0 / (5.5 * 5.5)}};
    for (std::size_t i = 0; i < scenes.size(); ++i) {
        const auto &[ways, factor, other] = lights[i];
        const double mean = factor * ways.all() + other;
        EXPECT_NEAR(scenes[i].expected / mean, 1.0, 1e-4) << scenes[i].name;
        EXPECT_GT(scenes[i].relative_std, factor * ways.deviation() / mean) << scenes[i].name;
        EXPECT_GT(0.02 * factor * ways.least() / mean, 2.0 * scenes[i].bound()) << scenes[i].name;
    }
}

TEST(SelftestReport, AnErrorAtItsBoundPassesAndBeyondFails) {
    cli::SelftestCheck check{"function", "sine", 2.5, 2.5, "ulp", ""};
    EXPECT_TRUE(check.passed());
    for (const double wrong : {2.5000001, std::numeric_limits<double>::infinity(), std::nan("")}) {
        check.error = wrong;
        EXPECT_FALSE(check.passed()) << wrong;
    }
}

} // namespace
