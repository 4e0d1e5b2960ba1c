// Images through a lens: of random scenes against an independent path tracer in double, and of scenes that are known
// exactly. Run alone with --gtest_filter=Lens*.
#include "tests/support/light_in_double.h"
#include "tests/support/scene_of.h"
#include "tests/support/shared_context.h"

#include <pt/film.h>
#include <pt/stats.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <numbers>
#include <random>
#include <string>
#include <vector>

namespace lens {

namespace {

using namespace light_in_double;

constexpr std::array<std::uint32_t, 4> samplers = {PT_SAMPLER_RANDOM, PT_SAMPLER_HALTON, PT_SAMPLER_HALTON_CP,
                                                   PT_SAMPLER_SOBOL};

// Balls about the origin, every third one moving, a lamp above, a floor; from so far away. With many balls there is a
// tree. Through a pinhole the height of the view is 4 at the origin.
Given random_scene(std::uint32_t seed, std::uint32_t balls, double distance) {
    std::mt19937 engine(seed);
    const auto uniform = [&](double low, double high) {
        return low + (high - low) * std::generate_canonical<double, 53>(engine);
    };
    Given given;
    for (std::uint32_t i = 0; i < balls; ++i) {
        const double size = 2.0 / std::cbrt(static_cast<double>(balls));
        pt_sphere ball{
            {uniform(-2, 2), uniform(-1.2, 1.5), uniform(-3, 3)}, size * uniform(0.3, 0.8), {0, 0, 0}, i % 2, 0};
        if (i % 3 == 0)
            ball.motion[i % 2] = uniform(-1, 1);
        given.spheres.push_back(ball);
    }
    given.spheres.push_back({{3, 5, uniform(-3, 3)}, 1.5, {0, 0, 0.5}, 2, 0});
    pt_camera &camera = given.camera;
    camera.struct_size = sizeof camera;
    camera.position[0] = 0.28 * distance;
    camera.position[2] = 0.96 * distance;
    camera.target[0] = 0.25;
    camera.up[0] = 0.3;
    camera.up[1] = 1;
    camera.vertical_fov = 2.0 * std::atan(2.0 / distance);
    camera.shutter_open = 0.25;
    camera.shutter_close = 0.75;
    camera.aperture = 0.25 * distance; // what is 2 behind the focus is spread over a disc of radius 0.25
    camera.focus = distance - 1.0;
    return given;
}

struct Case {
    std::string name;
    Given given;
    std::uint32_t reference_samples;
};

// Also a view so narrow that rays start ahead of the lens (a pixel is below 2^-14 of its distance), and a lens that the
// floor and a ball cut. What is below the floor has no light.
std::vector<Case> cases() {
    Given cut = random_scene(5, 7, 8.0);
    cut.camera.position[1] = -1.0;
    cut.spheres.push_back({{0.28 * 8.0 + 1.6, -1.0, 0.96 * 8.0}, 1.0, {0, 0, 0}, 0, 0});
    return {{"few", random_scene(1, 7, 8.0), 400},
            {"few, a narrow view", random_scene(2, 9, 8000.0), 400},
            {"few, the lens cut by surfaces", cut, 400},
            {"a tree", random_scene(3, 300, 8.0), 100},
            {"a tree, a narrow view", random_scene(4, 300, 8000.0), 100}};
}

using Lens = LightInDouble;

// The first scene by every sampler, the others, as each takes kernels of their own, by the default and by another in
// turn.
TEST_F(Lens, ShowsWhatAPathTracerInDoubleDoes) {
    const std::vector<Case> all = cases();
    for (std::size_t i = 0; i < all.size(); ++i) {
        const auto &[name, given, samples] = all[i];
        const Blocks exact = exact_blocks(given, samples);
        for (const std::uint32_t sampler : samplers)
            if (i == 0 || sampler == PT_SAMPLER_SOBOL || sampler == samplers[i % 3]) {
                EXPECT_LT(largest_error(given, exact, sampler), most_errors) << name << ", sampler " << sampler;
            }
    }
}

// A shining ball behind the focus whose disc is larger than the picture, so that its brightness goes by the inverse
// square of the disc's radius. Negative controls: a lens that is 3% wider and one whose focus is 3% farther, by which
// the brightness falls by 6% and by 9%, are told from it.
TEST_F(Lens, IsAsWideAndFocusedAsStated) {
    Given given;
    given.planes.clear();
    given.spheres = {{{0, 0, 0}, 3, {0, 0, 0}, 2, 0}};
    given.camera.struct_size = sizeof given.camera;
    given.camera.position[2] = 20;
    given.camera.up[1] = 1;
    given.camera.vertical_fov = 2.0 * std::atan(6.0 / 20.0);
    given.camera.aperture = 8.4;
    given.camera.focus = 6.0;
    const pt_render render = picture_of(PT_SAMPLER_SOBOL);
    const Blocks exact = exact_blocks(given, 10'000);
    const auto error = [&](const Given &other) {
        const Deviation found = deviation(context(), other, exact, render);
        return std::max(std::abs(found.of_image), found.largest);
    };
    EXPECT_LT(error(given), most_errors);
    Given wider = given;
    wider.camera.aperture *= 1.03;
    EXPECT_GT(error(wider), most_errors);
    Given farther = given;
    farther.camera.focus *= 1.03;
    EXPECT_GT(error(farther), most_errors);
}

// A ball in the plane in focus of 0.98 times a pixel's width: from the rim of the lens, a tenth beside the axis, its
// outline is larger by less than 0.6%, so that it fits into a pixel, and rounding is less than a thousandth of one. All
// its light is in that pixel, with as much of it as the ball covers, however wide the lens; a pixel's width out of
// focus it is not. The image is 24 x 16 pixels and 16 high at the focus, so that a pixel's side is 1 there.
TEST_F(Lens, IsSharpToThePixelInFocus) {
    // The latter starts ahead of the lens. Rays then miss their point by up to 2^-24 of the way that is left, here 2 R:
    // 0.001 of a pixel.
    for (const double distance : {80.0, 8e4})
        for (const double beyond : {0.0, 5.0}) {
            Given given;
            given.planes.clear();
            given.materials[2].emission[0] = given.materials[2].emission[1] = given.materials[2].emission[2] = 1;
            given.spheres = {{{2.5, 1.5, -beyond}, 0.49, {0, 0, 0}, 2, 0}};
            given.camera.struct_size = sizeof given.camera;
            given.camera.position[2] = distance;
            given.camera.vertical_fov = 2.0 * std::atan(8.0 / distance);
            given.camera.aperture = 0.2 * distance;
            pt_render render = picture_of(PT_SAMPLER_SOBOL);
            render.max_path_length = 1;
            const std::vector<float> image = render_image(context(), given.scene(), given.camera, render, 4096);
            EXPECT_TRUE(stats().features & PT_FEATURE_LENS);
            double elsewhere = 0.0;
            for (std::size_t i = 0; i < image.size(); ++i)
                if (i / 3 != 6 * picture.x + 14)
                    elsewhere += image[i];
            const double in_pixel = image[3 * (6 * picture.x + 14)];
            if (beyond > 0.0) {
                EXPECT_GT(elsewhere, in_pixel);
                continue;
            }
            EXPECT_EQ(elsewhere, 0.0) << distance;
            const double covered = std::numbers::pi * 0.49 * 0.49;
            EXPECT_NEAR(in_pixel, covered, 5.0 * std::sqrt(covered * (1.0 - covered) / 4096.0) + 0.006) << distance;
        }
}

// Rows alone, short submissions, two devices, and a film of one half of the samples to which the other is added, have
// the bits of the whole.
TEST_F(Lens, PartsHaveTheBitsOfTheWhole) {
    const Context hurried = create_context([](pt_create_info &info) { info.submit_milliseconds = 1; });
    const Context shared = create_context(
        [](pt_create_info &) {}, [](const auto *info, auto **made) { return create_shared(2, *info, made, true); });
    ASSERT_TRUE(hurried && shared);
    constexpr std::uint32_t first_row = 37;
    constexpr std::uint32_t row_count = 21;
    const std::vector<Case> all = cases();
    for (const std::size_t i : {1, 3}) { // a narrow view, a tree
        const Given &given = all[i].given;
        SCOPED_TRACE(all[i].name);
        pt_render render = picture_of(PT_SAMPLER_SOBOL);
        render.width *= 4;
        render.height *= 4;
        const std::vector<float> whole = render_image(context(), given.scene(), given.camera, render, 2);
        for (pt_context *const other : {hurried.get(), shared.get()})
            EXPECT_EQ(render_image(other, given.scene(), given.camera, render, 2), whole);

        pt_render second = render;
        second.first_sample = 1;
        render_image(hurried.get(), given.scene(), given.camera, second, 1);
        std::uint64_t size = 0;
        ASSERT_EQ(pt_save_film(hurried.get(), nullptr, &size), PT_OK);
        std::vector<std::byte> film(size);
        ASSERT_EQ(pt_save_film(hurried.get(), film.data(), &size), PT_OK);
        render_image(context(), given.scene(), given.camera, render, 1);
        ASSERT_EQ(pt_add_film(context(), film.data(), film.size()), PT_OK) << pt_last_error(context());
        std::vector<float> sum(whole.size());
        const pt_image target = image_target(sum);
        ASSERT_EQ(pt_readback(context(), &target), PT_OK) << pt_last_error(context());
        EXPECT_EQ(sum, whole);

        render.first_row = first_row;
        render.row_count = row_count;
        std::vector<float> rows = render_image(context(), given.scene(), given.camera, render, 2);
        rows.resize(std::size_t{3} * render.width * row_count);
        const auto from = whole.begin() + std::ptrdiff_t{3} * render.width * first_row;
        EXPECT_EQ(rows, std::vector<float>(from, from + static_cast<std::ptrdiff_t>(rows.size())));
    }
}

TEST_F(Lens, HasTheSameBitsOfAScaledScene) {
    for (const auto &[name, given, samples] : cases()) {
        const pt_render render = picture_of(PT_SAMPLER_SOBOL);
        const Given large = scaled(given, 0x1p20);
        EXPECT_EQ(render_image(context(), large.scene(), large.camera, render, 4),
                  render_image(context(), given.scene(), given.camera, render, 4))
            << name;
    }
}

// What camera rays meet first is that of the pinhole in the middle of the lens; and a lens without a diameter, whatever
// its focus, is a pinhole to the bit.
TEST_F(Lens, WithoutADiameterIsAPinhole) {
    Given lens = random_scene(1, 7, 8.0);
    Given pinhole = lens;
    pinhole.camera.aperture = 0.0;
    const pt_render render = picture_of(PT_SAMPLER_SOBOL);
    const std::vector<float> of_pinhole = render_image(context(), pinhole.scene(), pinhole.camera, render, 4);
    EXPECT_FALSE(stats().features & PT_FEATURE_LENS);
    Given unfocused = pinhole;
    unfocused.camera.focus = 0.0;
    EXPECT_EQ(render_image(context(), unfocused.scene(), unfocused.camera, render, 4), of_pinhole);
    std::vector<float> first_hits(of_pinhole.size());
    std::vector<float> through_lens(of_pinhole.size());
    for (const std::uint32_t quantity : {PT_QUANTITY_DEPTH, PT_QUANTITY_NORMAL, PT_QUANTITY_ALBEDO}) {
        const auto read = [&](const Given &given, std::vector<float> &values) {
            ASSERT_EQ(pt_set_camera(context(), &given.camera), PT_OK) << pt_last_error(context());
            const pt_image target = image_target(values, quantity);
            ASSERT_EQ(pt_readback(context(), &target), PT_OK) << pt_last_error(context());
        };
        read(pinhole, first_hits);
        read(lens, through_lens);
        // Of two kernels, each of which its driver may round in its own way.
        for (std::size_t i = 0; i < first_hits.size(); ++i) {
            const bool is_equal = through_lens[i] == first_hits[i]; // as infinite depths are
            EXPECT_TRUE(is_equal || std::abs(through_lens[i] - first_hits[i]) <= 1e-6 * std::max(1.0F, first_hits[i]))
                << quantity << ": " << through_lens[i] << " and " << first_hits[i];
        }
    }
    EXPECT_NE(render_image(context(), lens.scene(), lens.camera, render, 4), of_pinhole);
}

} // namespace

} // namespace lens
