// If every surface emits 1, coverage and mean radiance have the same bits, because sums are exact.
#include "tests/support/context_calls.h"
#include "tests/support/context_fixture.h"
#include "tests/support/coursework_scene.h"
#include "tests/support/scene_of.h"
#include "tests/support/shared_context.h"

#include <pt/film.h>

#include <algorithm>
#include <cstddef>
#include <random>
#include <string>
#include <vector>

namespace coverage {

namespace {

constexpr std::uint32_t picture_width = 29;
constexpr std::uint32_t picture_height = 19;

struct Shining {
    std::vector<pt_material> materials = {{{0, 0, 0}, {0, 0, 0}, {1, 1, 1}, 0, 0}};
    std::vector<pt_sphere> spheres;
    std::vector<pt_plane> planes;
    pt_camera camera = CourseworkScene::camera();
};

Shining some(std::uint32_t count, double motion) {
    Shining scene;
    std::mt19937 random(11);
    const auto share = [&] { return static_cast<double>(random() >> 8) * 0x1p-24; };
    for (std::uint32_t i = 0; i < count; ++i)
        scene.spheres.push_back({{8 * share() - 4, 4 * share(), -6 - 4 * share()},
                                 0.1 + 0.5 * share(),
                                 {motion * share(), -motion * share(), 0},
                                 0,
                                 0});
    scene.planes = {{{0, 1, 0}, 2, 0, 0}};
    scene.camera.shutter_open = 0.25;
    scene.camera.shutter_close = 1;
    return scene;
}

class Coverage : public ContextFixture {
protected:
    static pt_render picture(std::uint32_t sampler = PT_SAMPLER_BEST) {
        pt_render render = render_of(picture_width, picture_height, 1);
        render.sampler = sampler;
        render.seed = 77;
        render.flags = PT_RENDER_COVERAGE;
        return render;
    }

    static void set(pt_context *to, const Shining &shining, const pt_render &render) {
        const pt_scene scene = scene_of(shining.materials, shining.spheres, shining.planes);
        set_picture(to, scene, shining.camera, render);
    }

    static void take(pt_context *on, std::uint32_t samples, double target_error = 0.0) {
        const pt_accumulate_info info = accumulate_info(samples, target_error);
        ASSERT_GE(pt_accumulate(on, &info), PT_OK) << pt_last_error(on);
    }

    static std::vector<float> read(pt_context *from, std::uint32_t quantity) {
        return values_of(from, std::size_t{picture_width} * picture_height, quantity);
    }

    static void expect_that_of_radiance(pt_context *of) {
        const std::vector<float> expected = read(of, PT_QUANTITY_RADIANCE);
        EXPECT_EQ(read(of, PT_QUANTITY_COVERAGE), expected);
        EXPECT_TRUE(std::ranges::any_of(expected, [](float value) { return value > 0.0F && value < 1.0F; }));
    }
};

TEST_F(Coverage, IsThatOfTheSamplesThemselves) {
    struct Case {
        std::uint32_t spheres;
        double motion;
        std::uint32_t sampler;
        double aperture = 0.0;
        double extent = 0.0; // of a parallel view
    };
    for (const auto &[spheres, motion, sampler, aperture, extent] :
         {Case{5, 0.0, PT_SAMPLER_SOBOL}, Case{5, 1.5, PT_SAMPLER_HALTON_CP, 1.0},
          Case{90, 0.0, PT_SAMPLER_RANDOM, 1.0}, Case{90, 1.5, PT_SAMPLER_HALTON},
          Case{90, 0.0, PT_SAMPLER_SOBOL, 0.0, 6.0}}) {
        SCOPED_TRACE(std::to_string(spheres) + " spheres, sampler " + std::to_string(sampler));
        pt_render render = picture(sampler);
        render.first_sample = 3;
        Shining shining = some(spheres, motion);
        shining.camera.aperture = aperture;
        shining.camera.vertical_extent = extent;
        if (extent > 0.0) {
            shining.camera.projection = PT_PROJECTION_ORTHOGRAPHIC;
            shining.camera.vertical_fov = 0.0;
        }
        set(context(), shining, render);
        take(context(), 7);
        expect_that_of_radiance(context());
    }
}

TEST_F(Coverage, OfManySamplesIsTakenInParts) {
    const Context hurried = create_context([](pt_create_info &info) { info.submit_milliseconds = 1; });
    ASSERT_TRUE(hurried);
    for (pt_context *const each : {context(), hurried.get()}) {
        Shining shining = some(5, 1.0);
        for (const double aperture : {0.0, 0.5}) {
            shining.camera.aperture = aperture;
            set(each, shining, picture());
            take(each, 5000);
            expect_that_of_radiance(each);
        }
    }

    pt_render large = render_of(400, 300, 1);
    large.flags = PT_RENDER_COVERAGE;
    set(hurried.get(), some(5, 1.0), large);
    take(hurried.get(), 2);
    const auto values = [&](std::uint32_t quantity) { return values_of(hurried.get(), 400 * 300, quantity); };
    EXPECT_TRUE(values(PT_QUANTITY_COVERAGE) == values(PT_QUANTITY_RADIANCE));
}

TEST_F(Coverage, KnowsWhichSamplesEachTileHas) {
    const Context adaptive = create_context([](pt_create_info &) {}, shared_by(1, false, 16));
    ASSERT_TRUE(adaptive);
    set(adaptive.get(), some(5, 0.0), picture());
    take(adaptive.get(), 4096, 0.01);
    const std::vector<float> counts = read(adaptive.get(), PT_QUANTITY_SAMPLE_COUNT);
    ASSERT_LT(*std::ranges::min_element(counts), *std::ranges::max_element(counts));
    expect_that_of_radiance(adaptive.get());

    pt_render later = picture();
    later.first_sample = 5000;
    later.row_count = 8;
    set(context(), some(5, 0.0), later);
    take(context(), 9);
    const std::vector<char> rows_later = film_of(context());
    later.first_sample = 70;
    later.first_row = 8;
    set(context(), some(5, 0.0), later);
    take(context(), 5);
    const std::vector<char> rows_earlier = film_of(context());
    pt_render whole = picture();
    whole.first_sample = 2000;
    set(context(), some(5, 0.0), whole);
    take(context(), 4);
    for (const std::vector<char> &film : {rows_later, rows_earlier})
        ASSERT_EQ(pt_add_film(context(), film.data(), film.size()), PT_OK) << pt_last_error(context());
    expect_that_of_radiance(context());
}

TEST_F(Coverage, OfSeveralDevicesAndOfLittleToHit) {
    const Context shared = create_context([](pt_create_info &) {}, shared_by(2, true));
    ASSERT_TRUE(shared);
    set(shared.get(), some(90, 1.0), picture());
    take(shared.get(), 6);
    expect_that_of_radiance(shared.get());

    Shining narrow = some(0, 0.0);
    narrow.planes.clear();
    narrow.spheres = {{{0, 0, -1e8}, 3, {0, 0, 0}, 0, 0}};
    narrow.camera.vertical_fov = 2e-7;
    set(context(), narrow, picture());
    take(context(), 6);
    expect_that_of_radiance(context());

    set(context(), Shining{}, picture());
    take(context(), 2);
    EXPECT_EQ(read(context(), PT_QUANTITY_COVERAGE),
              std::vector<float>(std::size_t{3} * picture_width * picture_height));
}

} // namespace

} // namespace coverage
