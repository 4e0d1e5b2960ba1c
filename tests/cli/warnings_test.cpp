#include "cli/render/warnings.h"

#include <gtest/gtest.h>

#include <optional>
#include <string>
#include <vector>

namespace {

using cli::image_warnings;
using cli::input_warnings;
using Texts = std::vector<std::string>;

const std::string camera = R"("camera": {"position": [0, 0, 1], "look_at": [0, 0, 0]}, )";
const std::string materials =
    R"("materials": {"lamp": {"emission": 1}, "blue lamp": {"emission": [0, 0, 1]}, "grey": {"diffuse": 0.5}})";

Texts warnings_of(const std::string &members, const std::string &camera_members = camera) {
    const cli::SceneFile scene =
        cli::parse_scene(std::string("{").append(camera_members).append(members).append("}"), "s.json");
    return input_warnings(scene, std::nullopt, 0.0);
}

std::string scene_of(const std::string &spheres, const std::string &planes = "") {
    return R"("spheres": [)" + spheres + R"(], "planes": [)" + planes + "], " + materials;
}

std::string sphere(double x, double radius, const std::string &material) {
    return R"({"center": [)" + std::to_string(x) + R"(, 0, 1], "radius": )" + std::to_string(radius) +
           R"(, "material": ")" + material + R"("})";
}

std::string lamp_plane(double distance) {
    return R"({"normal": [2, 0, 0], "offset": )" + std::to_string(-2.0 * distance) + R"(, "material": "lamp"})";
}

const Texts unlit{"s.json: no surface emits light: the picture is black"};

TEST(Warnings, NoLight) {
    EXPECT_EQ(warnings_of("", ""), unlit);
    EXPECT_EQ(warnings_of(scene_of(sphere(9, 1, "grey"))), unlit);
    EXPECT_EQ(warnings_of(scene_of(sphere(9, 1, "blue lamp"))), Texts());
    EXPECT_EQ(warnings_of(scene_of("", lamp_plane(3))), Texts());
}

TEST(Warnings, MaterialsThatGiveOffMoreThanTheyReceive) {
    const auto with = [](const std::string &more) {
        return warnings_of(
            R"("materials": {"lamp": {"emission": 1}, "a b": {"diffuse": [0.1, 0.9, 0.3], "specular": )" + more +
            R"(}, "c": {"diffuse": 2}}, "planes": [{"normal": [0, 1, 0], "offset": 1,
                           "material": "a b"}], "spheres": [{"center": [0, 5, 0], "radius": 1, "material": "lamp"}])");
    };
    EXPECT_EQ(with("0.1"), Texts()); // In float32 0.1 + 0.9 is 1. The material c is not used.
    EXPECT_EQ(with("[0.9, 0, 0.7]"), Texts());
    EXPECT_EQ(with("0.101"),
              Texts{"s.json: materials[\"a b\"]: diffuse + specular = 1: more light is reflected than received"});
    EXPECT_EQ(with("[0, 0, 0.9]"),
              Texts{"s.json: materials[\"a b\"]: diffuse + specular = 1.2: more light is reflected than received"});
}

TEST(Warnings, ManyMaterialsAreOneWarning) {
    std::string materials_text = R"("lamp": {"emission": 1})";
    std::string spheres = sphere(9, 1, "lamp");
    for (const char *name : {"a", "b", "c", "d", "e"}) {
        materials_text.append(", \"").append(name).append(R"(": {"specular": 1.5})");
        spheres.append(", ").append(sphere(20, 1, name));
    }
    EXPECT_EQ(warnings_of(R"("materials": {)" + materials_text + R"(}, "spheres": [)" + spheres + "]"),
              Texts{"s.json: materials.a, materials.b, materials.c and 2 more: diffuse + specular = 1.5 at most: "
                    "more light is reflected than received"});
}

TEST(Warnings, ColorsOfBytesComeWithTheirLight) {
    EXPECT_EQ(warnings_of(R"("materials": {"lamp": {"emission": 1}, "red": {"diffuse": [160, 25, 25]}}, "spheres": [)" +
                          sphere(9, 1, "lamp") + ", " + sphere(20, 1, "red") + "]"),
              Texts{"s.json: materials.red: diffuse + specular = 160: more light is reflected than received; the sRGB "
                    "color 160, 25, 25 is [0.352, 0.00972, 0.00972]"});
}

TEST(Warnings, TargetsThatSayNothing) {
    const cli::SceneFile scene =
        cli::parse_scene(std::string("{").append(scene_of(sphere(9, 1, "lamp"))).append("}"), "s.json");
    EXPECT_EQ(input_warnings(scene, std::nullopt, 0.999), Texts());
    EXPECT_EQ(input_warnings(scene, std::nullopt, 1.0).size(), 1U);
    EXPECT_EQ(input_warnings(scene, std::nullopt, 2.0),
              Texts{"--error: the target is 200%; two percent are written 2% or 0.02"});
}

TEST(Warnings, OfTheLibraryNameTheFilesField) {
    const cli::SceneFile scene = cli::parse_scene(std::string("{")
                                                      .append(camera)
                                                      .append(scene_of(sphere(9, 1, "lamp")))
                                                      .append(",\n\"capsules\": [{\"center\": [0, 0, 0], \"end\": "
                                                              "[1e5, 0, 0], \"radius\": 1, \"material\": \"grey\"}]}"),
                                                  "s.json");
    const cli::BrokenRule rule{"sphere_arrays", 0, "end", 0, "", "(1e+05, 0, 0)", "is too long"};
    EXPECT_EQ(input_warnings(scene, rule, 0.0), Texts{"s.json:2: capsules[0].end = (1e+05, 0, 0): is too long"});
}

TEST(Warnings, SamplesLeftOut) {
    cli::RenderReport report{};
    report.render.width = 1;
    report.render.height = 4;
    report.window = {{0, 1, 1, 2}, 1, 4};
    report.stats.sample_count = 8;
    const std::vector<float> two_pixels(6, 0.18F);
    EXPECT_EQ(image_warnings(report, two_pixels), Texts());
    report.stats.rejected_samples = 4;
    EXPECT_EQ(image_warnings(report, two_pixels),
              Texts{"4 samples (25%) were left out: not finite, negative or too bright"});
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
