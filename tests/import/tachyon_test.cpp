// Scenes of Tachyon: every section, by exact values.
#include "cli/scene/scene_override.h"
#include "tests/import/imported.h"

#include <gtest/gtest.h>

#include <cmath>

namespace {

using imported::changed;
using imported::material_of;

// z counts the other way there.
const std::string tachyon = "# as VMD has it\n"
                            "Begin_Scene\nResolution 64 32\n"
                            "Shader_Mode Medium Trans_Max_Surfaces 4 End_Shader_Mode\n"
                            "Camera\n  Zoom 0.5\n  Aspectratio 1\n  Antialiasing 0\n  Raydepth 8\n"
                            "  Center 1 2 -3\n  Viewdir 0 0 2\n  Updir 0 1 0.5\nEnd_Camera\n"
                            "Directional_Light Direction 0 -3 0 Color 1 0.5 0.25\n"
                            "Background 0.5 0.25 0.125\n"
                            "TexDef gold Ambient 0.2 Diffuse 0.5 Specular 0 Opacity 1 Phong Metal 0.5 Phong_size 18\n"
                            "  Color 1 0.5 0.25 TexFunc 0\n"
                            "TexAlias metal gold\n"
                            "Sphere Center 2 2 7 Rad 2 metal\n"
                            "Sphere Center 0 2 7 Rad 1 Texture Ambient 0 Diffuse 1 Specular 0.75 Opacity 1\n"
                            "  Phong Plastic 0.5 Phong_size 18 Color 0 0.5 1 TexFunc 0\n"
                            "Plane Center 0 -5 4 Normal 0 2 1 gold\n"
                            "Light Center 2 2 -6 Rad 0.5 Color 0.5 1 2\n"
                            "End_Scene\n";

cli::SceneFile parse_tachyon(const std::string &text) {
    return cli::parse_scene(text, "a.dat");
}

cli::SceneFile parse_changed(const std::string &from, const std::string &to) {
    return parse_tachyon(changed(tachyon, from, to));
}

std::string tachyon_message(const std::string &from, const std::string &to) {
    return imported::message_of(changed(tachyon, from, to), "a.dat");
}

TEST(Tachyon, CameraIsThatOfTheFile) {
    const cli::SceneFile scene = parse_tachyon(tachyon);
    EXPECT_EQ(scene.width, 64U);
    EXPECT_EQ(scene.height, 32U);
    EXPECT_EQ(scene.camera.position[0], 1.0);
    EXPECT_EQ(scene.camera.position[2], 3.0);
    EXPECT_EQ(scene.camera.up[2], -0.5);
    EXPECT_NEAR(std::tan(scene.camera.vertical_fov / 2), 1.0, 1e-14); // half of 1 / ZOOM
    // The point of the view that is nearest to the middle of the box around both spheres, (1.5, 2, -7).
    EXPECT_EQ(scene.camera.target[0], 1.0);
    EXPECT_EQ(scene.camera.target[1], 2.0);
    EXPECT_EQ(scene.camera.target[2], -7.0);
}

TEST(Tachyon, ProjectionsOfTheFile) {
    const cli::SceneFile parallel = parse_changed("Zoom 0.5", "Projection Orthographic Zoom 0.5");
    EXPECT_EQ(parallel.camera.projection, PT_PROJECTION_ORTHOGRAPHIC);
    EXPECT_EQ(parallel.camera.vertical_extent, 2.0);
    const cli::SceneFile framed = parse_changed("End_Camera", "Frustum -1.5 1.5 -0.75 0.75 End_Camera");
    EXPECT_NEAR(std::tan(framed.camera.vertical_fov / 2), 0.75, 1e-14);
    const cli::SceneFile focused =
        parse_changed("Zoom 0.5", "Projection Perspective_DoF FocalLength 3 Aperture 0.1 Zoom 0.5");
    EXPECT_EQ(focused.left_out, std::vector<std::string>{"a.dat:6: PERSPECTIVE_DOF: depth of field is left out"});
    EXPECT_NEAR(std::tan(focused.camera.vertical_fov / 2), 1.0, 1e-14);
}

TEST(Tachyon, SurfacesAreThoseOfTheFile) {
    const cli::SceneFile scene = parse_tachyon(tachyon);
    ASSERT_EQ(scene.spheres.size(), 5U);
    EXPECT_EQ(scene.spheres[0].center[0], 2.0);
    EXPECT_EQ(scene.spheres[0].center[2], -7.0);
    EXPECT_EQ(scene.spheres[0].radius, 2.0);
    ASSERT_EQ(scene.planes.size(), 1U);
    EXPECT_EQ(scene.planes[0].normal[1], 2.0);
    EXPECT_EQ(scene.planes[0].normal[2], -1.0);
    EXPECT_EQ(scene.planes[0].offset, 6.0); // 2 y - z + 6 is 0 at (0, -5, -4)
    EXPECT_EQ(scene.planes[0].material, scene.spheres[0].material);
    const pt_material &gold = material_of(scene, 0);
    EXPECT_EQ(gold.diffuse[0], 0.5F);
    EXPECT_EQ(gold.diffuse[2], 0.125F);
    EXPECT_EQ(gold.specular[0], 0.05F); // (18 + 2) / 2 times that is 0.5
    EXPECT_EQ(gold.specular[2], 0.0125F);
    EXPECT_EQ(gold.glossiness, 18.0F);
    const pt_material &mirror = material_of(scene, 1);
    EXPECT_EQ(mirror.diffuse[1], 0.5F);
    EXPECT_EQ(mirror.specular[0], 0.75F);
    EXPECT_EQ(mirror.glossiness, 1e6F);
    EXPECT_EQ(material_of(parse_changed("Metal", "Plastic"), 0).specular[2], 0.05F);
    EXPECT_EQ(scene.left_out, std::vector<std::string>());
}

TEST(Tachyon, EqualTexturesWithoutNamesAreOneMaterial) {
    std::string spheres;
    for (const char *color : {"1 0 0", "0 1 0", "1 0 0"})
        spheres += "SPHERE CENTER 0 0 0 RAD 1 TEXTURE AMBIENT 0 DIFFUSE 1 SPECULAR 0 OPACITY 1 COLOR " +
                   std::string(color) + " TEXFUNC 0\n";
    const cli::SceneFile scene = parse_changed("Plane", spheres + "Plane");
    EXPECT_EQ(scene.spheres[2].material, scene.spheres[4].material);
    EXPECT_NE(scene.spheres[2].material, scene.spheres[3].material);
}

TEST(Tachyon, LightsAreLamps) {
    const cli::SceneFile scene = parse_tachyon(tachyon);
    // A hundred times the distance of the light, which is farthest: sqrt(1 + 13^2).
    const pt_sphere &sun = scene.spheres[2];
    const double distance = 100 * std::sqrt(170.0);
    EXPECT_NEAR(sun.center[1], 2 + distance, 1e-9);
    EXPECT_NEAR(sun.radius, distance / 50, 1e-9);
    EXPECT_NEAR(material_of(scene, 2).emission[0], 2500, 1e-3);
    EXPECT_NEAR(material_of(scene, 2).emission[2], 625, 1e-3);
    const pt_sphere &lamp = scene.spheres[3];
    EXPECT_EQ(lamp.center[2], 6.0);
    EXPECT_EQ(lamp.radius, 0.5);
    EXPECT_FALSE(scene.is_hidden(lamp.material));
    EXPECT_NEAR(material_of(scene, 3).emission[0], 0.5 * 170 / 0.25, 1e-3);
    EXPECT_NEAR(material_of(scene, 3).emission[2], 2 * 170 / 0.25, 1e-3);
    const cli::SceneFile faded =
        parse_changed("Rad 0.5 Color", "Rad 0.5 Attenuation Constant 1 Linear 0 Quadratic 0.1 Color");
    EXPECT_NEAR(material_of(faded, 3).emission[0], 0.5 * 170 / 0.25 / 18, 1e-3);
}

TEST(Tachyon, MessagesNamePlaceValueAndRule) {
    EXPECT_EQ(tachyon_message("Sphere Center 0", "FCylinder Base 0"),
              "a.dat:20: FCYLINDER is a finite cylinder: spheres, planes, lights and a camera alone can be rendered");
    EXPECT_EQ(tachyon_message("Sphere Center 0", "STri V0 0"),
              "a.dat:20: STRI is a smooth triangle: spheres, planes, lights and a camera alone can be rendered");
    EXPECT_EQ(
        tachyon_message("Sphere Center 0", "Ball Center 0"),
        "a.dat:20: \"BALL\": must be CAMERA, BACKGROUND, LIGHT, DIRECTIONAL_LIGHT, TEXDEF, TEXALIAS, SPHERE, PLANE, "
        "SHADER_MODE or END_SCENE");
    EXPECT_EQ(tachyon_message("Rad 2 metal", "Rad 2 silver"),
              "a.dat:19: \"silver\": must be TEXTURE or the name of a TEXDEF before it");
    EXPECT_EQ(tachyon_message("Rad 2 ", "Rad -2 "), "a.dat:19: RAD: must be above 0");
    EXPECT_EQ(tachyon_message("Rad 2 ", "2 "), "a.dat:19: \"2\" must be RAD");
    EXPECT_EQ(tachyon_message("Aspectratio 1", "Aspectratio 1.5"),
              "a.dat:7: ASPECTRATIO: must be 1, pixels are square");
    EXPECT_EQ(tachyon_message("Zoom 0.5", "Projection Fisheye Zoom 0.5"),
              "a.dat:6: PROJECTION \"FISHEYE\": must be PERSPECTIVE, PERSPECTIVE_DOF or ORTHOGRAPHIC");
    EXPECT_EQ(tachyon_message("End_Camera", "Frustum -1 1 -0.25 0.75 End_Camera"),
              "a.dat:13: FRUSTUM: must be even about the middle, and of square pixels");
    EXPECT_EQ(tachyon_message("Normal 0 2 1", "Normal 0 0 0"), "a.dat:22: NORMAL: must not be 0 0 0");
    EXPECT_EQ(tachyon_message("End_Scene", ""), "a.dat:23: the file ends where END_SCENE must be: it was cut short");
    EXPECT_EQ(tachyon_message("TexFunc 0", "TexFunc 11"), "a.dat:17: TEXFUNC: must be a whole number from 0 to 10");
    EXPECT_EQ(imported::message_of("BEGIN_SCENE RESOLUTION 2 2 END_SCENE", "a"), "a:1: there is no CAMERA");
}

TEST(Tachyon, WhatIsLeftOutIsSaidOnce) {
    const std::string wood = changed(tachyon, "TexFunc 0",
                                     "TexFunc 9 wood.ppm Center 0 0 0 Rotate 0 0 0 Scale 1 1 1 "
                                     "UAxis 1 0 0 VAxis 0 1 0");
    const std::string glass = changed(changed(wood, "Opacity 1", "Opacity 0.5"), "Opacity 1", "Opacity 0");
    const std::string shaded =
        changed(glass, "Trans_Max_Surfaces 4", "Ambient_Occlusion Ambient_Color 1 1 1 Rescale_Direct 0.3 Samples 12");
    EXPECT_EQ(parse_tachyon(shaded).left_out,
              (std::vector<std::string>{
                  "a.dat:4: AMBIENT_OCCLUSION: its light from all sides is left out",
                  "a.dat:16: OPACITY: light through surfaces is left out, they are opaque",
                  "a.dat:17: TEXFUNC: patterns and images on surfaces are left out, their plain colour is used"}));
}

TEST(Tachyon, ValuesCanBeSetAsInSceneFiles) {
    const std::vector<cli::SceneOverride> overrides{cli::parse_override("spheres[0].radius=1.25"),
                                                    cli::parse_override("camera.vertical_fov=60")};
    const cli::SceneFile scene = cli::parse_scene(tachyon, "a.dat", overrides);
    EXPECT_EQ(scene.spheres[0].radius, 1.25);
    EXPECT_NEAR(std::tan(scene.camera.vertical_fov / 2), std::sqrt(1.0 / 3.0), 1e-14);
}

} // namespace
