// Images of parallel rays, of random scenes, beside those of a path tracer of their own in double. Run alone with
// --gtest_filter=ParallelLight*.
#include "tests/support/light_in_double.h"

#include <array>
#include <cmath>
#include <random>
#include <string>
#include <vector>

namespace parallel_light {

namespace {

using namespace light_in_double;

constexpr std::array<std::uint32_t, 4> samplers = {PT_SAMPLER_RANDOM, PT_SAMPLER_HALTON, PT_SAMPLER_HALTON_CP,
                                                   PT_SAMPLER_SOBOL};

// Balls about the origin, two lamps above, a floor; the rays start so far away. With many balls there is a tree.
Given random_scene(std::uint32_t seed, std::uint32_t balls, double distance) {
    std::mt19937 engine(seed);
    const auto uniform = [&](double low, double high) {
        return low + (high - low) * std::generate_canonical<double, 53>(engine);
    };
    Given given;
    for (std::uint32_t i = 0; i < balls; ++i) {
        const double size = 2.0 / std::cbrt(static_cast<double>(balls));
        pt_sphere ball{
            {uniform(-2, 2), uniform(-1.5, 1.5), uniform(-2, 2)}, size * uniform(0.3, 1), {0, 0, 0}, i % 2, 0};
        if (i % 3 == 0)
            ball.motion[i % 2] = uniform(-1, 1);
        given.spheres.push_back(ball);
    }
    for (const double side : {-1.0, 1.0})
        given.spheres.push_back({{3 * side, 5, uniform(-3, 3)}, 1.5, {0, 0, 0.5 * side}, 2, 0});
    const glm::dvec3 from = distance * glm::normalize(glm::dvec3(uniform(-1, 1), uniform(0.2, 1), uniform(0.5, 1)));
    pt_camera &camera = given.camera;
    camera.struct_size = sizeof camera;
    for (int i = 0; i < 3; ++i)
        camera.position[i] = from[i];
    camera.target[0] = 0.25;
    camera.up[0] = 0.3;
    camera.up[1] = 1;
    camera.projection = PT_PROJECTION_ORTHOGRAPHIC;
    camera.vertical_extent = 4;
    camera.shutter_open = 0.25;
    camera.shutter_close = 0.75;
    return given;
}

// The floor in the middle of the view and of the balls, so that rays start on both sides of it, but of no ball. What is
// below has no light.
Given divided_by_the_floor() {
    Given given = random_scene(5, 7, 1.0);
    given.planes[0].offset = 0;
    given.camera.position[0] = 0.5;
    given.camera.position[1] = 0.25;
    given.camera.position[2] = 8.0;
    return given;
}

struct Case {
    std::string name;
    Given given;
    std::uint32_t reference_samples;
};

// From within, rays start in balls and on both sides of them.
std::vector<Case> cases() {
    return {{"few, from afar", random_scene(1, 7, 1e5), 1000},
            {"few, from within", random_scene(2, 9, 0.5), 1000},
            {"few, on both sides of the floor", divided_by_the_floor(), 1000},
            {"a tree, from afar", random_scene(3, 300, 20), 100},
            {"a tree, from within", random_scene(4, 300, 0.25), 100}};
}

using ParallelLight = LightInDouble;

// The first scene by every sampler, the others, as each takes kernels of their own, by the default and by another in
// turn. Negative controls: views of the first that are a fiftieth wider, or turned by a twentieth, are told from it.
TEST_F(ParallelLight, OfEachSamplerIsThatOfAPathTracerInDouble) {
    const std::vector<Case> all = cases();
    for (std::size_t i = 0; i < all.size(); ++i) {
        const auto &[name, given, samples] = all[i];
        const Blocks exact = exact_blocks(given, samples);
        for (const std::uint32_t sampler : samplers)
            if (i == 0 || sampler == PT_SAMPLER_SOBOL || sampler == samplers[i % 3]) {
                EXPECT_LT(largest_error(given, exact, sampler), most_errors) << name << ", sampler " << sampler;
            }
        if (i > 0)
            continue;
        Given wider = given;
        wider.camera.vertical_extent *= 1.02;
        EXPECT_GT(largest_error(wider, exact, PT_SAMPLER_SOBOL), most_errors);
        Given turned = given;
        turned.camera.up[0] += 0.05;
        EXPECT_GT(largest_error(turned, exact, PT_SAMPLER_SOBOL), most_errors);
    }
}

// Rows alone, and short submissions, on a CPU of a part of the pixels, have the bits of the whole.
TEST_F(ParallelLight, RowsAndPiecesHaveTheBitsOfTheWhole) {
    const Context hurried = create_context([](pt_create_info &info) { info.submit_milliseconds = 1; });
    ASSERT_TRUE(hurried);
    constexpr std::uint32_t first_row = 37;
    constexpr std::uint32_t row_count = 21;
    std::uint32_t sampler = PT_SAMPLER_SOBOL;
    for (const auto &[name, given, samples] : cases()) {
        SCOPED_TRACE(name);
        pt_render render = picture_of(sampler);
        sampler = sampler == PT_SAMPLER_SOBOL ? PT_SAMPLER_HALTON_CP : PT_SAMPLER_SOBOL;
        render.width *= 4;
        render.height *= 4;
        const std::vector<float> whole = render_image(context(), given.scene(), given.camera, render, 2);
        EXPECT_EQ(render_image(hurried.get(), given.scene(), given.camera, render, 2), whole);
        render.first_row = first_row;
        render.row_count = row_count;
        std::vector<float> rows = render_image(context(), given.scene(), given.camera, render, 2);
        rows.resize(std::size_t{3} * render.width * row_count);
        const auto from = whole.begin() + std::ptrdiff_t{3} * render.width * first_row;
        EXPECT_EQ(rows, std::vector<float>(from, from + static_cast<std::ptrdiff_t>(rows.size())));
    }
}

} // namespace

} // namespace parallel_light
