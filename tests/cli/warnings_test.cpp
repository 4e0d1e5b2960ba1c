#include "cli/render/warnings.h"

#include <gtest/gtest.h>

#include <optional>
#include <string>
#include <vector>

namespace {

using cli::image_warnings;
using cli::input_warnings;
using Texts = std::vector<std::string>;

// Every name in `used` is the material of a sphere.
cli::SceneFile scene_of(const std::string &materials, const std::vector<std::string> &used,
                        const std::string &rest = "") {
    std::string spheres;
    for (const std::string &name : used) {
        spheres.append(spheres.empty() ? "" : ",");
        spheres.append(R"({"center": [9, 0, 1], "radius": 1, "material": ")").append(name).append("\"}");
    }
    return cli::parse_scene(R"({"materials": {)" + materials + R"(}, "spheres": [)" + spheres + "]" + rest + "}",
                            "s.json");
}

Texts warnings_of(const std::string &materials, const std::vector<std::string> &used) {
    return input_warnings(scene_of(materials, used), std::nullopt, 0.0);
}

TEST(Warnings, NoLight) {
    const Texts unlit{"s.json: no surface emits light: the picture is black"};
    EXPECT_EQ(warnings_of(R"("lamp": {"emission": 1}, "grey": {})", {"grey"}), unlit);
    EXPECT_EQ(warnings_of(R"("lamp": {"emission": [0, 0, 1]})", {"lamp"}), Texts());
}

TEST(Warnings, MaterialsThatGiveOffMoreThanTheyReceive) {
    const auto with = [](const std::string &specular) {
        return warnings_of(R"("lamp": {"emission": 1}, "c": {"diffuse": 2},
                              "a b": {"diffuse": [0.1, 0.9, 0.3], "specular": )" +
                               specular + "}",
                           {"lamp", "a b"});
    };
    const std::string rule = ": more light is reflected than received";
    EXPECT_EQ(with("0.1"), Texts()); // In float32 0.1 + 0.9 is 1. The material c is not used.
    EXPECT_EQ(with("[0.9, 0, 0.7]"), Texts());
    EXPECT_EQ(with("0.101"), Texts{"s.json: materials[\"a b\"]: diffuse + specular = 1" + rule});
    EXPECT_EQ(with("[0, 0, 0.9]"), Texts{"s.json: materials[\"a b\"]: diffuse + specular = 1.2" + rule});
    EXPECT_EQ(
        warnings_of(R"("lamp": {"emission": 1}, "a": {"specular": 1.5}, "b": {"specular": 1.5},
                             "c": {"specular": 1.5}, "d": {"specular": 1.5}, "e": {"specular": 1.5})",
                    {"lamp", "a", "b", "c", "d", "e"}),
        Texts{"s.json: materials.a, materials.b, materials.c and 2 more: diffuse + specular = 1.5 at most" + rule});
    EXPECT_EQ(warnings_of(R"("lamp": {"emission": 1}, "red": {"diffuse": [160, 25, 25]})", {"lamp", "red"}),
              Texts{"s.json: materials.red: diffuse + specular = 160" + rule +
                    "; the sRGB color 160, 25, 25 is [0.352, 0.00972, 0.00972]"});
}

TEST(Warnings, OfTheLibraryNameTheFilesField) {
    const cli::SceneFile scene = scene_of(R"("lamp": {"emission": 1}, "grey": {})", {"lamp"},
                                          ",\n\"capsules\": [{\"center\": [0, 0, 0], \"end\": [1e5, 0, 0], "
                                          "\"radius\": 1, \"material\": \"grey\"}]");
    const cli::BrokenRule rule{"sphere_arrays", 0, "end", 0, "", "(1e+05, 0, 0)", "is too long"};
    EXPECT_EQ(input_warnings(scene, rule, 0.0), Texts{"s.json:2: capsules[0].end = (1e+05, 0, 0): is too long"});
    EXPECT_EQ(input_warnings(scene, std::nullopt, 0.999), Texts());
    EXPECT_EQ(input_warnings(scene, std::nullopt, 1.0).size(), 1U);
}

TEST(Warnings, BlackPictures) {
    cli::RenderReport report{};
    std::vector<float> radiance(6, 0.0F);
    EXPECT_EQ(image_warnings(report, radiance),
              Texts{"no sample hit light: the picture is black, and the stated error of 0 says nothing; is the camera "
                    "inside a ball, or every lamp behind a surface?"});
    report.warnings = {"s.json: no surface emits light: the picture is black"};
    EXPECT_EQ(image_warnings(report, radiance), Texts());
    report.warnings.clear();
    radiance[4] = 1e-30F;
    EXPECT_EQ(image_warnings(report, radiance), Texts());
}

TEST(Warnings, SamplesLeftOutAreAShareOfTheRenderedPart) {
    cli::RenderReport report{};
    report.render.width = 1;
    report.render.height = 4;
    report.window = {{0, 1, 1, 2}, 1, 4};
    report.stats.sample_count = 8;
    report.stats.rejected_samples = 4;
    EXPECT_EQ(image_warnings(report, std::vector<float>(6, 0.18F)),
              Texts{"4 samples (25%) were left out: not finite, negative or too bright"});
}

TEST(Warnings, PicturesThatAreDarkerThanTheErrorTells) {
    cli::RenderReport report{};
    std::vector<float> radiance(300, 0.18F * 0x1p-12F);
    EXPECT_EQ(image_warnings(report, radiance), Texts()) << "no target";
    report.target_error = 0.01;
    EXPECT_EQ(image_warnings(report, radiance),
              Texts{"--error: the picture is so dark that a relative error says little: "
                    "multiply all emission by 2^12, or ask for much less"});
    std::ranges::fill(radiance, 0.18F * 0x1p-4F);
    EXPECT_EQ(image_warnings(report, radiance), Texts());
}

} // namespace
