// Images of parallel rays, of random scenes, beside those of a path tracer of their own in double. Run alone with
// --gtest_filter=ParallelLight*.
#include "tests/support/context_fixture.h"
#include "tests/support/double_path_tracer.h"
#include "tests/support/render_image.h"
#include "tests/support/scene_of.h"

#include <array>
#include <cmath>
#include <random>
#include <string>
#include <vector>

namespace parallel_light {

namespace {

constexpr glm::uvec2 picture(24, 16);
constexpr glm::uvec2 block(8, 8);
constexpr std::uint32_t image_count = 12;
constexpr std::uint32_t samples_of_image = 32;
constexpr std::array<std::uint32_t, 4> samplers = {PT_SAMPLER_RANDOM, PT_SAMPLER_HALTON, PT_SAMPLER_HALTON_CP,
                                                   PT_SAMPLER_SOBOL};
// That one of 120 blocks is off by more, in standard errors that 12 images tell, has a chance of 1/200; seeds are
// fixed.
constexpr double most_errors = 6.5;

struct Given {
    std::vector<pt_material> materials{{{0.8F, 0.6F, 0.4F}, {0, 0, 0}, {0, 0, 0}, 0},
                                       {{0.5F, 0.5F, 0.5F}, {0, 0, 0}, {0, 0, 0}, 0},
                                       {{0.2F, 0.2F, 0.2F}, {0, 0, 0}, {3, 4, 5}, 0}};
    std::vector<pt_sphere> spheres;
    std::vector<pt_plane> planes{{{0, 1, 0}, 1.5, 1, 0}};
    pt_camera camera{};

    pt_scene scene() const { return scene_of(materials, spheres, planes); }
};

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

using Blocks = std::vector<DoublePathTracer::Estimate>;

constexpr pt_render picture_of(std::uint32_t sampler) {
    pt_render render{};
    render.struct_size = sizeof render;
    render.width = picture.x;
    render.height = picture.y;
    render.max_path_length = 3;
    render.sampler = sampler;
    return render;
}

Blocks exact_blocks(const Given &given, std::uint32_t samples) {
    const pt_scene scene = given.scene();
    DoublePathTracer tracer(scene, given.camera, 7);
    Blocks blocks;
    for (std::uint32_t y = 0; y < picture.y; y += block.y)
        for (std::uint32_t x = 0; x < picture.x; x += block.x)
            blocks.push_back(tracer.of_rectangle(picture_of(PT_SAMPLER_RANDOM), {x, y}, block, samples));
    return blocks;
}

double mean_of_block(const std::vector<float> &image, glm::uvec2 first) {
    double sum = 0.0;
    for (std::uint32_t i = 0; i < block.x * block.y; ++i)
        for (std::uint32_t colour = 0; colour < 3; ++colour)
            sum += image[3 * ((first.y + i / block.x) * picture.x + first.x + i % block.x) + colour];
    return sum / (3.0 * block.x * block.y);
}

class ParallelLight : public ContextFixture {
protected:
    // How far off the block is that is farthest off, in standard errors. The images have other seeds and, as the points
    // of one sampler do not depend on the seed, other samples.
    double largest_error(const Given &given, const Blocks &exact, std::uint32_t sampler) {
        std::vector<std::vector<float>> images;
        pt_render render = picture_of(sampler);
        for (render.seed = 1; render.seed <= image_count; ++render.seed) {
            images.push_back(render_image(context(), given.scene(), given.camera, render, samples_of_image));
            render.first_sample += samples_of_image;
        }
        double largest = 0.0;
        for (std::uint32_t i = 0; i < exact.size(); ++i) {
            const glm::uvec2 first = block * glm::uvec2(i % (picture.x / block.x), i / (picture.x / block.x));
            double sum = 0.0;
            double squares = 0.0;
            for (const std::vector<float> &image : images) {
                const double mean = mean_of_block(image, first);
                sum += mean;
                squares += mean * mean;
            }
            const double mean = sum / image_count;
            const double variance = (squares / image_count - mean * mean) / (image_count - 1);
            largest = std::max(largest, std::abs(mean - exact[i].mean) /
                                            std::sqrt(variance + exact[i].variance + 1e-12)); // of a black block
        }
        return largest;
    }
};

TEST_F(ParallelLight, OfEachSamplerIsThatOfAPathTracerInDouble) {
    for (const auto &[name, given, samples] : cases()) {
        const Blocks exact = exact_blocks(given, samples);
        for (const std::uint32_t sampler : samplers)
            EXPECT_LT(largest_error(given, exact, sampler), most_errors) << name << ", sampler " << sampler;
    }
}

// A view that is a fiftieth wider, or turned by a twentieth, is told from it.
TEST_F(ParallelLight, OfAnotherViewIsSeen) {
    const Given given = random_scene(1, 7, 1e5);
    const Blocks exact = exact_blocks(given, 1000);
    Given wider = given;
    wider.camera.vertical_extent *= 1.02;
    EXPECT_GT(largest_error(wider, exact, PT_SAMPLER_SOBOL), most_errors);
    Given turned = given;
    turned.camera.up[0] += 0.05;
    EXPECT_GT(largest_error(turned, exact, PT_SAMPLER_SOBOL), most_errors);
}

// Rows alone, and short submissions, on a CPU of a part of the pixels, have the bits of the whole.
TEST_F(ParallelLight, RowsAndPiecesHaveTheBitsOfTheWhole) {
    const Context hurried = create_context([](pt_create_info &info) { info.submit_milliseconds = 1; });
    ASSERT_TRUE(hurried);
    constexpr std::uint32_t first_row = 37;
    constexpr std::uint32_t row_count = 21;
    for (const auto &[name, given, samples] : cases())
        for (const std::uint32_t sampler : {PT_SAMPLER_HALTON_CP, PT_SAMPLER_SOBOL}) {
            SCOPED_TRACE(name + ", sampler " + std::to_string(sampler));
            pt_render render = picture_of(sampler);
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
