// Tests of cli/scene/animation, and of the names of frames.
#include "cli/scene/animation.h"

#include "cli/base/exit_code.h"
#include "cli/render/render_options.h"
#include "cli/scene/scene_file.h"

#include <gtest/gtest.h>

#include <string>
#include <vector>

namespace {

using cli::parse_scene;
using cli::SceneFile;

using Numbers = std::vector<double>;

// A scene whose camera, sphere and lamp move; shutter: of the camera.
SceneFile moving_scene(const std::string &shutter) {
    return parse_scene(R"({
  "camera": { "position": [0, 0, 9], "look_at": [0, 0, 0], "shutter": )" +
                           shutter + R"( },
  "materials": { "the lamp": { "emission": 1 } },
  "spheres": [ { "center": [9, 9, 9], "radius": 1, "material": "the lamp", "motion": [9, 9, 9] } ],
  "animation": {
    "camera.position": [[10, [0, 0, 0]], [14, [4, 8, 0]]],
    "spheres[0].center": [[10, [0, 0, 0]], [12, [2, 0, 0]], [14, [2, 6, 0]]],
    "materials[\"the lamp\"].emission": [[0, 1], [20, 11]]
  }
})",
                       "s.json");
}

SceneFile at_frame(const SceneFile &scene, const std::string &shutter, std::uint32_t frame) {
    // The same text again, with the values of the frame.
    return parse_scene(R"({
  "camera": { "position": [0, 0, 9], "look_at": [0, 0, 0], "shutter": )" +
                           shutter + R"( },
  "materials": { "the lamp": { "emission": 1 } },
  "spheres": [ { "center": [9, 9, 9], "radius": 1, "material": "the lamp", "motion": [9, 9, 9] } ]
})",
                       "s.json", cli::overrides_of_frame(scene, frame));
}

template <std::size_t Count>
Numbers list(const double (&values)[Count]) {
    return {values, values + Count};
}

TEST(Animation, ValuesAreOnStraightLinesBetweenKeyFrames) {
    const SceneFile scene = moving_scene("[0, 1]");
    ASSERT_EQ(scene.animation.size(), 3U);
    const cli::AnimatedValue &camera = scene.animation[0];
    EXPECT_EQ(camera.at(12.0), (Numbers{2.0, 4.0, 0.0}));
    EXPECT_EQ(camera.at(12.5), (Numbers{2.5, 5.0, 0.0}));
    for (const double time : {0.0, 9.9, 10.0}) {
        EXPECT_EQ(camera.at(time), (Numbers{0.0, 0.0, 0.0})) << time;
    }
    for (const double time : {14.0, 14.1, 1e9}) {
        EXPECT_EQ(camera.at(time), (Numbers{4.0, 8.0, 0.0})) << time;
    }
    EXPECT_EQ(scene.animation[2].at(5.0), Numbers{3.5});
}

TEST(Animation, SpheresMoveWithinAFrame) {
    const SceneFile scene = moving_scene("[0, 1]");
    const auto sphere = [&](std::uint32_t frame) { return at_frame(scene, "[0, 1]", frame).spheres.at(0); };
    EXPECT_EQ(list(sphere(9).center), (Numbers{0, 0, 0}));
    EXPECT_EQ(list(sphere(9).motion), (Numbers{0, 0, 0})); // not that of the file
    EXPECT_EQ(list(sphere(11).center), (Numbers{1, 0, 0}));
    EXPECT_EQ(list(sphere(11).motion), (Numbers{1, 0, 0}));
    EXPECT_EQ(list(sphere(12).center), (Numbers{2, 0, 0}));
    EXPECT_EQ(list(sphere(12).motion), (Numbers{0, 3, 0})); // round the corner
    EXPECT_EQ(list(sphere(14).motion), (Numbers{0, 0, 0}));
}

TEST(Animation, AllElseIsAsInTheMiddleOfTheShutter) {
    const auto frame = [](const std::string &shutter) { return at_frame(moving_scene(shutter), shutter, 11); };
    EXPECT_EQ(list(frame("[0, 1]").camera.position), (Numbers{1.5, 3, 0}));
    EXPECT_EQ(list(frame("[0, 0]").camera.position), (Numbers{1, 2, 0}));
    EXPECT_EQ(list(frame("[0.5, 1]").camera.position), (Numbers{1.75, 3.5, 0}));
    EXPECT_EQ(frame("[0, 0]").materials.at(0).emission[0], 6.5F);
    EXPECT_EQ(list(frame("[0, 0]").spheres.at(0).center), (Numbers{1, 0, 0})); // at the begin whatever the shutter
}

TEST(Animation, MistakesAreRefused) {
    const auto refusal = [](const std::string &members) -> std::string {
        try {
            parse_scene("{\"animation\": {" + members + "}}", "s.json");
        } catch (const cli::Failure &failure) {
            EXPECT_EQ(failure.code(), cli::ExitCode::scene);
            return failure.what();
        }
        return "";
    };
    EXPECT_EQ(refusal(R"("camera.position": [[0, [1, 2, 3]]])"), "");
    for (const char *name :
         {"camera", "film.width", "render.seed", "camera.shutter", "spheres.center", "spheres[0]",
          "spheres[0].center[1]", "materials[0].diffuse", "camera.position=", "", "planes[0].", "x"}) {
        EXPECT_NE(refusal("\"" + std::string(name) + "\": [[0, 1]]").find("the name must be that of a key"),
                  std::string::npos)
            << name;
    }
    const auto keys = [&](const std::string &value) { return refusal("\"camera.position\": " + value); };
    const std::string place = "s.json:1: animation[\"camera.position\"]";
    EXPECT_EQ(keys("[]"), place + ": must be an array of key frames, [frame, value] each");
    EXPECT_EQ(keys("{}"), place + ": must be an array of key frames, [frame, value] each");
    EXPECT_EQ(keys("[0, [1, 2, 3]]"), place + "[0]: must be [frame, value]");
    EXPECT_EQ(keys("[[0]]"), place + "[0]: must be [frame, value]");
    EXPECT_EQ(keys("[[-1, 1]]"), place + "[0][0]: must be a whole number from 0 to 4294967295, is -1");
    EXPECT_EQ(keys("[[0, \"a\"]]"), place + "[0][1]: must be a number, is \"a\"");
    EXPECT_EQ(keys("[[0, [1, null]]]"), place + "[0][1][1]: must be a number, is null");
    EXPECT_EQ(keys("[[0, 1], [0, 2]]"), place + "[1][0]: must be a later frame than the one before");
    EXPECT_EQ(keys("[[0, [1, 2]], [3, [1]]]"), place + "[1][1]: must have as many numbers as the one before");
    EXPECT_EQ(keys("[[0, [1]], [3, 1]]"), place + "[1][1]: must have as many numbers as the one before");
}

TEST(Animation, MistakesOfAFrameNameIt) {
    const SceneFile scene = parse_scene(R"({"animation": {"spheres[3].radius": [[0, 1]]}})", "s.json");
    try {
        parse_scene("{}", "s.json", cli::overrides_of_frame(scene, 7));
        FAIL() << "was accepted";
    } catch (const cli::Failure &failure) {
        EXPECT_EQ(failure.code(), cli::ExitCode::scene);
        EXPECT_STREQ(failure.what(),
                     "s.json: animation[\"spheres[3].radius\"] in frame 7: the scene has no spheres[3]");
    }
}

TEST(FrameRange, IsReadFromText) {
    EXPECT_EQ(cli::parse_frames("3-17").value().first, 3U);
    EXPECT_EQ(cli::parse_frames("3-17").value().last, 17U);
    EXPECT_EQ(cli::parse_frames("5").value().last, 5U);
    EXPECT_EQ(cli::parse_frames("5-5").value().first, 5U);
    for (const char *text : {"", "-", "-3", "3-", "4-3", "a", "1-2-3", "1.5", "4294967296", " 1"}) {
        EXPECT_FALSE(cli::parse_frames(text)) << text;
    }
}

TEST(FrameRange, NumbersNames) {
    EXPECT_EQ(cli::numbered_name("f-####.png", 7), "f-0007.png");
    EXPECT_EQ(cli::numbered_name("f-##.png", 12345), "f-12345.png");
    EXPECT_EQ(cli::numbered_name("#", 0), "0");
    EXPECT_EQ(cli::numbered_name("#1/###", 12), "#1/012"); // the last of them
    EXPECT_EQ(cli::numbered_name("a.png", 1), std::nullopt);
}

} // namespace
