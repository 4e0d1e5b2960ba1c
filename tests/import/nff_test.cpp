// Scenes in NFF: every entity, by exact values.
#include "cli/scene/warnings.h"
#include "tests/import/imported.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace {

using imported::changed;
using imported::material_of;

const std::string nff = "# two balls\n"
                        "v\nfrom 1 2 3\nat 1 2 -7\nup 0 1 0.5\nangle 90\nhither 0.1\nresolution 64 33\n"
                        "b 0.125 0.25 0.5\n"
                        "l 1 12 -7\nl 11 2 -7 0.5 0.25 1\n"
                        "f 0.5 1 0.25 0.5 0.25 20 0 1\n"
                        "s 1 2 -7 2\n"
                        "f 1 1 1 1 0 0 0 1\n"
                        "s 0 -4 -7.5 -1.5   # seen from inside\n";

cli::SceneFile parse_nff(const std::string &text) {
    return cli::parse_scene(text, "a.nff");
}

std::string nff_message(const std::string &from, const std::string &to) {
    return imported::message_of(changed(nff, from, to), "a.nff");
}

TEST(Nff, CameraIsThatOfTheFile) {
    const cli::SceneFile scene = parse_nff(nff);
    EXPECT_EQ(scene.width, 64U);
    EXPECT_EQ(scene.height, 33U);
    EXPECT_EQ(scene.camera.position[2], 3.0);
    EXPECT_EQ(scene.camera.target[2], -7.0);
    EXPECT_EQ(scene.camera.up[2], 0.5);
    EXPECT_EQ(scene.camera.projection, PT_PROJECTION_PERSPECTIVE);
    // 45 degrees above and below the middle are the middles of the first and of the last row, 16 rows away.
    EXPECT_NEAR(std::tan(scene.camera.vertical_fov / 2), 16.5 / 16.0, 1e-14);
}

TEST(Nff, SpheresAndMaterialsAreThoseOfTheFile) {
    const cli::SceneFile scene = parse_nff(nff);
    ASSERT_EQ(scene.spheres.size(), 5U); // with two lamps and the sky
    EXPECT_EQ(scene.spheres[0].center[2], -7.0);
    EXPECT_EQ(scene.spheres[0].radius, 2.0);
    EXPECT_EQ(scene.spheres[1].center[1], -4.0);
    EXPECT_EQ(scene.spheres[1].radius, 1.5);
    const pt_material &first = material_of(scene, 0);
    EXPECT_EQ(first.diffuse[0], 0.25F);
    EXPECT_EQ(first.diffuse[1], 0.5F);
    EXPECT_EQ(first.diffuse[2], 0.125F);
    EXPECT_EQ(first.specular[1], 0.25F);
    EXPECT_EQ(first.glossiness, 20.0F);
    EXPECT_EQ(material_of(scene, 1).diffuse[0], 1.0F);
    EXPECT_EQ(material_of(scene, 1).specular[0], 0.0F);
    EXPECT_TRUE(scene.is_hidden(scene.spheres[2].material)); // lamps of lights
    EXPECT_FALSE(scene.is_hidden(scene.spheres[4].material));
    EXPECT_EQ(scene.left_out, std::vector<std::string>());
}

TEST(Nff, BackgroundIsASkyAroundAll) {
    const cli::SceneFile scene = parse_nff(nff);
    const pt_sphere &sky = scene.spheres.back();
    const pt_material &material = material_of(scene, 4);
    EXPECT_EQ(material.emission[0], 0.125F);
    EXPECT_EQ(material.emission[2], 0.5F);
    EXPECT_EQ(material.diffuse[0], 0.0F);
    EXPECT_EQ(sky.radius, 1e7); // 1e6 times the distance of the camera and of both lights
    EXPECT_EQ(parse_nff(changed(nff, "b 0.125 0.25 0.5", "b 0 0 0")).spheres.size(), 4U);
    EXPECT_EQ(parse_nff(changed(nff, "b 0.125 0.25 0.5", "")).spheres.size(), 4U);
}

TEST(Nff, LightsWithoutColoursShareTheirIntensity) {
    const cli::SceneFile scene = parse_nff(nff);
    // Both are 10 from what is looked at: a 50th, of which the square is 2500.
    EXPECT_EQ(scene.spheres[2].radius, 0.2);
    EXPECT_EQ(scene.spheres[2].center[1], 12.0);
    EXPECT_NEAR(material_of(scene, 2).emission[0], 2500 / std::numbers::sqrt2, 1e-3);
    EXPECT_EQ(scene.spheres[3].center[0], 11.0);
    EXPECT_NEAR(material_of(scene, 3).emission[0], 1250, 1e-3);
    EXPECT_NEAR(material_of(scene, 3).emission[1], 625, 1e-3);
    EXPECT_NEAR(material_of(scene, 3).emission[2], 2500, 1e-3);
}

TEST(Nff, FormsOfTextDoNotMatter) {
    std::string returns;
    for (const char c : nff)
        returns += c == '\n' ? std::string("\r\n") : std::string(1, c);
    for (const std::string &text :
         {returns, "\xef\xbb\xbf" + nff, changed(nff, "from", "\tfrom\t"), nff.substr(0, nff.size() - 1)})
        EXPECT_EQ(parse_nff(text).spheres.size(), 5U);
    EXPECT_EQ(cli::parse_scene(nff, "standard input").spheres.size(), 5U); // known by its first words
    EXPECT_EQ(cli::parse_scene(changed(nff, "# two balls\n", "b 1 1 1\n"), "a.NFF").spheres.size(), 5U);
}

TEST(Nff, MessagesNamePlaceValueAndRule) {
    EXPECT_EQ(nff_message("s 0", "c 0"),
              "a.nff:15: \"c\" is a cone or cylinder: of shapes, spheres alone can be rendered");
    EXPECT_EQ(nff_message("s 0", "pp 3"),
              "a.nff:15: \"pp\" is a polygonal patch: of shapes, spheres alone can be rendered");
    EXPECT_EQ(nff_message("s 0", "p 3"), "a.nff:15: \"p\" is a polygon: of shapes, spheres alone can be rendered");
    EXPECT_EQ(nff_message("s 0", "q 3"), "a.nff:15: \"q\": must be one of v, b, l, f and s");
    EXPECT_EQ(nff_message("-1.5", "0"), "a.nff:15: the radius of a sphere, \"s\", must not be 0");
    EXPECT_EQ(nff_message("-1.5", "nan"), "a.nff:15: the radius of a sphere, \"s\", = \"nan\": must be finite");
    EXPECT_EQ(nff_message("-1.5", "1,5"),
              "a.nff:15: the radius of a sphere, \"s\", = \"1,5\": must be a number, with a decimal point");
    EXPECT_EQ(nff_message(" -1.5 ", " "),
              "a.nff:15: the file ends where the radius of a sphere, \"s\", must be: it was cut short");
    EXPECT_EQ(nff_message("angle 90", "angle 180"), "a.nff:6: angle: must be above 0 and below 180");
    EXPECT_EQ(nff_message("hither 0.1\n", ""), "a.nff:7: \"resolution\" must be \"hither\" of a viewpoint");
    EXPECT_EQ(nff_message("at 1 2 -7", "at 1 2 3"), "a.nff:4: at: must not be where \"from\" is");
    EXPECT_EQ(nff_message("up 0 1 0.5", "up 0 0 0"), "a.nff:5: up: must not be 0 0 0");
    EXPECT_EQ(nff_message("64 33", "64 0"), "a.nff:8: resolution = \"0\": must be a whole number from 1");
    EXPECT_EQ(nff_message("f 0.5", "f -0.5"), "a.nff:12: the colour of a fill, \"f\",: must not be negative");
    EXPECT_EQ(nff_message("f 0.5 1 0.25 0.5 0.25 20 0 1\n", ""),
              "a.nff:12: a sphere, \"s\", comes before the first fill, \"f\"");
    EXPECT_EQ(nff_message("b 0.125", "v"), "a.nff:9: there is a second viewpoint, \"v\"");
    EXPECT_EQ(imported::message_of("b 1 1 1\n", "a.nff"), "a.nff:1: there is no viewpoint, \"v\"");
    EXPECT_EQ(imported::message_of("", "a.nff"), "a.nff:1: there is no viewpoint, \"v\"");
}

TEST(Nff, WhatIsLeftOutIsSaidOnce) {
    const std::string glass = changed(changed(nff, "20 0 1", "20 0.5 1.5"), "0 0 0 1", "0 0 1 1.5");
    const cli::SceneFile scene = parse_nff(glass);
    const std::vector<std::string> expected{"a.nff:12: T: light through surfaces is left out, they are opaque"};
    EXPECT_EQ(scene.left_out, expected);
    EXPECT_EQ(cli::input_warnings(scene, cli::merge_settings({}, scene)), expected);
}

} // namespace
