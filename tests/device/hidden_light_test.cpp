// Images of random scenes of which a part is hidden from the camera, beside those of a path tracer of their own in
// double. PT_TEST_SCENES says of how many; by default some. Run alone with --gtest_filter=HiddenLight*.
#include "tests/support/light_in_double.h"

#include <cmath>
#include <cstdlib>
#include <random>
#include <string>

namespace hidden_light {

namespace {

using namespace light_in_double;

constexpr std::uint32_t material_count = 3; // and each again, hidden
constexpr std::uint32_t lamp = 2;
constexpr std::uint32_t reference_samples = 1000;

std::uint32_t scene_count() {
    const char *const asked = std::getenv("PT_TEST_SCENES");
    return asked ? static_cast<std::uint32_t>(std::atoi(asked)) : 6;
}

// Balls that cut each other, a floor, sometimes a wall, walls of which one sees the back, a sky and a hidden ball about
// the camera; any of them may be hidden, and lamps.
Given random_scene(std::uint32_t seed) {
    std::mt19937 engine(seed);
    const auto uniform = [&](double low, double high) {
        return low + (high - low) * std::generate_canonical<double, 53>(engine);
    };
    const auto chance = [&](double probability) { return uniform(0, 1) < probability; };
    const auto perhaps_hidden = [&](std::uint32_t material) { return material + (chance(0.4) ? material_count : 0); };

    Given given;
    const std::vector<pt_material> seen = given.materials;
    given.materials.insert(given.materials.end(), seen.begin(), seen.end());
    given.flags = {0, 0, 0, 1, 1, 1};
    const bool has_tree = seed % 4 == 3;
    const int balls = has_tree ? 150 : 7;
    for (int i = 0; i < balls; ++i) {
        const std::uint32_t material = chance(0.15) ? lamp : chance(0.5) ? 1 : 0;
        const bool may_hide = !has_tree || i % 10 == 0;
        pt_sphere ball{{uniform(-2, 2), uniform(-1.5, 1.5), uniform(-2, 2)},
                       uniform(0.4, 1.3) * (has_tree ? 0.35 : 1.0),
                       {0, 0, 0},
                       may_hide ? perhaps_hidden(material) : material,
                       0};
        if (chance(0.3))
            ball.motion[i % 3] = uniform(-1, 1);
        given.spheres.push_back(ball);
    }
    given.spheres.push_back({{0, 0, 0}, uniform(15, 30), {0, 0, 0}, perhaps_hidden(lamp), 0});
    given.planes[0].material = perhaps_hidden(1);
    if (chance(0.5)) // between the camera and the balls, or through them
        given.planes.push_back({{uniform(-0.2, 0.2), uniform(-0.2, 0.2), 1}, -uniform(0, 4), material_count + 1, 0});

    pt_camera &camera = given.camera;
    camera.struct_size = sizeof camera;
    camera.position[0] = uniform(-2, 2);
    camera.position[1] = uniform(-0.5, 2);
    camera.position[2] = 6;
    camera.target[0] = uniform(-0.5, 0.5);
    camera.up[1] = 1;
    camera.shutter_open = 0.25;
    camera.shutter_close = 0.75;
    if (chance(0.3)) {
        camera.projection = PT_PROJECTION_ORTHOGRAPHIC;
        camera.vertical_extent = 5;
    } else {
        camera.vertical_fov = 0.8;
    }
    if (chance(0.4)) {
        pt_sphere about{{0, 0, 0}, uniform(0.5, 5), {0, 0, 0}, material_count + (chance(0.5) ? lamp : 0), 0};
        for (int i = 0; i < 3; ++i)
            about.center[i] = camera.position[i];
        given.spheres.push_back(about);
    }
    return given;
}

class HiddenLight : public LightInDouble {};

TEST_F(HiddenLight, IsThatOfAPathTracerInDouble) {
    for (std::uint32_t seed = 1; seed <= scene_count(); ++seed) {
        const Given given = random_scene(seed);
        EXPECT_LT(largest_error(given, exact_blocks(given, reference_samples), PT_SAMPLER_SOBOL), most_errors)
            << "scene " << seed;
    }
}

// Where nothing is hidden any more it is another image.
TEST_F(HiddenLight, OfWhatIsSeenIsAnother) {
    std::uint32_t others = 0;
    for (std::uint32_t seed = 1; seed <= 4; ++seed) {
        const Given given = random_scene(seed);
        Given seen = given;
        seen.flags.assign(given.flags.size(), 0);
        const Blocks exact = exact_blocks(given, reference_samples);
        others += largest_error(seen, exact, PT_SAMPLER_SOBOL) > most_errors ? 1 : 0;
    }
    EXPECT_GE(others, 3U);
}

} // namespace

} // namespace hidden_light
