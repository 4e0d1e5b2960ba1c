// Tests of cli/selftest: the judgement passes what is right and fails what is wrong, and the report says so. Whether
// the scenes are right is tested where there is a device, by selftest_test.py.
#include "cli/selftest/selftest.h"

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <cmath>
#include <cstring>
#include <limits>
#include <numbers>
#include <set>

namespace {

using cli::SelftestScene;

std::vector<float> image_of(const SelftestScene &scene, double radiance) {
    return std::vector<float>(std::size_t{3} * scene.scene.render.width * scene.scene.render.height,
                              static_cast<float>(radiance));
}

TEST(SelftestScene, RightImagesPass) {
    for (const SelftestScene &scene : cli::selftest_scenes()) {
        EXPECT_TRUE(scene.judge(image_of(scene, scene.expected)).passed()) << scene.name;
        if (scene.relative_std > 0.0) { // without noise the bound may be less than a step of float32
            const double near = scene.expected * (1.0 + 0.8 * scene.bound());
            EXPECT_TRUE(scene.judge(image_of(scene, near)).passed()) << scene.name;
        }
    }
}

TEST(SelftestScene, WrongImagesFail) {
    for (const SelftestScene &scene : cli::selftest_scenes()) {
        for (const double factor :
             {1.0 + 1.2 * scene.bound() + 0x1p-22, 1.0 - 1.2 * scene.bound() - 0x1p-22, 0.0, -1.0}) {
            EXPECT_FALSE(scene.judge(image_of(scene, scene.expected * factor)).passed()) << scene.name << factor;
        }
        EXPECT_LT(scene.bound(), 0.02) << scene.name << " judges too mildly";
    }
}

TEST(SelftestScene, ASingleNumberThatIsNotFiniteFails) {
    for (const SelftestScene &scene : cli::selftest_scenes()) {
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
            for (std::size_t i = channel; i < radiance.size(); i += 3) {
                radiance[i] *= 1.03F;
            }
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

// The closed form against the integral over time that it stands for, by the midpoint rule.
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

TEST(SelftestScene, NamesDiffer) {
    std::set<std::string> names;
    for (const SelftestScene &scene : cli::selftest_scenes()) {
        EXPECT_TRUE(names.insert(scene.name).second) << scene.name;
    }
}

cli::SelftestReport example_selftest() {
    cli::SelftestReport report{};
    std::strcpy(report.device.name, "a device");
    std::strcpy(report.device.driver, "its driver 1.2");
    report.device.kind = PT_DEVICE_DISCRETE_GPU;
    report.device.memory_bytes = std::uint64_t{3} << 30;
    report.checks = {{"function", "sine", 2.5, 2.5, "ulp", "worst at 0.5"},
                     {"scene", "ball", 0.0, 0.0, "relative", ""}};
    return report;
}

TEST(SelftestReport, AnErrorAtItsBoundPassesAndBeyondFails) {
    cli::SelftestCheck check{"function", "sine", 2.5, 2.5, "ulp", ""};
    EXPECT_TRUE(check.passed());
    for (const double wrong : {2.5000001, std::numeric_limits<double>::infinity(), std::nan("")}) {
        check.error = wrong;
        EXPECT_FALSE(check.passed()) << wrong;
    }
}

TEST(SelftestReport, HasWhatAReportOfAFaultNeeds) {
    const std::string text = cli::selftest_text(example_selftest());
    for (const char *part : {"device  a device\n", "driver  its driver 1.2\n", "kind    discrete GPU\n",
                             "memory  3.0 GiB\n", "pass  sine ", "worst at 0.5\n", "\npassed: all 2 checks\n"}) {
        EXPECT_NE(text.find(part), std::string::npos) << part << "\n" << text;
    }
    EXPECT_EQ(text.find("FAIL"), std::string::npos);
}

TEST(SelftestReport, OneFailureIsTheVerdict) {
    cli::SelftestReport report = example_selftest();
    report.checks[1].error = 1e-9;
    EXPECT_FALSE(report.passed());
    const std::string text = cli::selftest_text(report);
    EXPECT_NE(text.find("FAIL  ball "), std::string::npos) << text;
    EXPECT_TRUE(text.ends_with("\nFAILED: 1 of 2 checks\n")) << text;
}

TEST(SelftestReport, Json) {
    cli::SelftestReport report = example_selftest();
    EXPECT_EQ(cli::selftest_json(report).at("passed"), true);
    report.checks[0].error = std::numeric_limits<double>::infinity();
    const auto json = cli::selftest_json(report);
    EXPECT_EQ(json.at("passed"), false);
    EXPECT_EQ(json.at("device").at("kind"), "discrete GPU");
    EXPECT_TRUE(json.at("checks")[0].at("error").is_null());
    EXPECT_EQ(json.at("checks")[0].at("passed"), false);
    EXPECT_EQ(json.at("checks")[1].at("passed"), true);
    EXPECT_EQ(json.at("checks")[1].at("error"), 0.0);
}

} // namespace
