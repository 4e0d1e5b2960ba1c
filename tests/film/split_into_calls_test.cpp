#include "lib/film/error_estimate.h"
#include "tests/kernel/coursework_view.h"
#include "tests/kernel/probe.h"
#include "tests/support/context_calls.h"
#include "tests/support/context_fixture.h"
#include "tests/support/coursework_scene.h"
#include "tests/support/image_target.h"
#include "tests/support/render_image.h"
#include "tests/support/scene_of.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

namespace {

constexpr uint32_t width = 200;
constexpr uint32_t height = 75;

using Image = std::vector<float>;

class SplitIntoCalls : public ContextFixture {
protected:
    void set_up_coursework(pt_context *on, uint32_t max_path_length) {
        set_coursework(on, render_of(width, height, max_path_length));
    }

    Image image_of(const std::vector<uint32_t> &calls) {
        set_up_coursework(context(), 3);
        for (const uint32_t samples : calls)
            accumulate(samples);
        Image image(width * height * 3);
        readback(image);
        return image;
    }

    Image image_inside_a_lamp(float radiance, uint32_t samples) {
        const pt_material material{{0, 0, 0}, {0, 0, 0}, {radiance, radiance, radiance}, 0, 0};
        const pt_sphere sphere{{0, 0, 0}, 50, {0, 0, 0}, 0, 0};
        const pt_scene scene = scene_of({&material, 1}, {&sphere, 1}, {});
        return render_image(context(), scene, CourseworkScene::camera(), render_of(8, 8, 1), samples);
    }
};

TEST_F(SplitIntoCalls, SplittingOverCallsKeepsTheBits) {
    const Image at_once = image_of({64});
    EXPECT_EQ(image_of(std::vector<uint32_t>(64, 1)), at_once);
    EXPECT_EQ(image_of({7, 19, 38}), at_once);
    EXPECT_NE(image_of({7, 19, 37}), at_once) << "a missing sample must show";
}

// A call may exceed the limits of a dispatch or of the table of points.
class GatheringTest : public SplitIntoCalls {
protected:
    Context create_fixtures_context() override {
        return create_context([](pt_create_info &info) { info.submit_milliseconds = 1000; });
    }

    struct Paths {
        uint32_t sampler;
        uint32_t max_length;
    };

    Image small_image_of(const Paths &paths, const std::vector<uint32_t> &calls) {
        pt_render render = render_of(3, 1, paths.max_length);
        render.sampler = paths.sampler;
        set_coursework(context(), render);
        for (const uint32_t samples : calls)
            accumulate(samples);
        EXPECT_EQ(stats().rejected_samples, 0U);
        Image image(std::size_t{3} * 3);
        readback(image);
        return image;
    }

    uint32_t most_of_a_dispatch(const Paths &paths) {
        const pt::Features features =
            coursework_view({3, 1, paths.max_length, 0, 0, PT_ESTIMATOR_MIS, paths.sampler, 0, 1})->features;
        const uint32_t row_blocks = pt::point_layout(features).row_blocks();
        const pt::vulkan::Limits &limits = probe_device().limits();
        uint64_t most = std::min<uint64_t>(pt::gpu::FILM_MAX_GATHERED,
                                           limits.loop_trip_budget / pt::loop_trips_per_sample(features));
        if (row_blocks > 0)
            most = std::min<uint64_t>(most, limits.max_uniform_range / sizeof(pt::PointBlock) / row_blocks);
        return static_cast<uint32_t>(most);
    }

    void expect_same_in_pieces(const Paths &paths, uint32_t sample_count) {
        const uint64_t submissions = stats().submit_count;
        const Image at_once = small_image_of(paths, {sample_count});
        EXPECT_EQ(stats().submit_count, submissions + 1) << sample_count << " samples";
        std::vector<uint32_t> pieces;
        for (uint32_t left = sample_count; left > 0; left -= pieces.back())
            pieces.push_back(std::min(left, 211U));
        EXPECT_EQ(small_image_of(paths, pieces), at_once) << sample_count << " samples";
        pieces.back() -= 1;
        EXPECT_NE(small_image_of(paths, pieces), at_once) << "a missing sample must show";
    }
};

// Dispatches end at powers of two, so the largest one starts at a power of two.
TEST_F(GatheringTest, OfRandomSamplesKeepsTheBits) {
    constexpr Paths paths{PT_SAMPLER_RANDOM, 2};
    constexpr uint32_t most = pt::gpu::FILM_MAX_GATHERED;
    ASSERT_EQ(most_of_a_dispatch(paths), most);
    for (const uint32_t sample_count : {most - 1, most, most + 1, most + 2, 3 * most + 3})
        expect_same_in_pieces(paths, 1024 + sample_count);
}

TEST_F(GatheringTest, OfPointsFromATableKeepsTheBits) {
    constexpr Paths paths{PT_SAMPLER_SOBOL, 3};
    const uint32_t most = most_of_a_dispatch(paths);
    ASSERT_LT(most, 512U);
    ASSERT_GT(most, 211U);
    for (const uint32_t sample_count : {most - 1, most, most + 1, 512 + 3 * most + 1})
        expect_same_in_pieces(paths, 512 + sample_count);
}

TEST_F(SplitIntoCalls, TheTargetErrorIsReachedAtTheFirstCheckThatSaysSo) {
    constexpr uint32_t most = 4096;
    constexpr double target = 0.07;
    set_up_coursework(context(), 3);
    const pt_accumulate_info until_target{sizeof until_target, most, nullptr, nullptr, target,
                                          PT_SAMPLING_UNIFORM, 0,    nullptr, 0,       0};
    ASSERT_EQ(pt_accumulate(context(), &until_target), PT_TARGET_REACHED) << pt_last_error(context());
    const pt_stats reached = stats();
    EXPECT_GT(reached.sample_count, 16U);
    EXPECT_LT(reached.sample_count, most);
    EXPECT_LE(error().relative_rmse_high, target);

    ASSERT_EQ(pt_accumulate(context(), &until_target), PT_TARGET_REACHED);
    EXPECT_EQ(stats().sample_count, reached.sample_count);

    set_up_coursework(context(), 3);
    uint64_t before = pt::next_check(0);
    while (pt::next_check(before) < reached.sample_count)
        before = pt::next_check(before);
    accumulate(static_cast<uint32_t>(before));
    EXPECT_GT(error().relative_rmse_high, target);
}

TEST_F(SplitIntoCalls, SamplesMayRunOutBeforeTheTargetErrorIsReached) {
    set_up_coursework(context(), 3);
    for (const double target : {1e-9, 1e9}) {
        const pt_accumulate_info info{sizeof info, 8, nullptr, nullptr, target, PT_SAMPLING_UNIFORM, 0, nullptr, 0, 0};
        ASSERT_EQ(pt_accumulate(context(), &info), PT_OK) << pt_last_error(context());
    }
    EXPECT_EQ(stats().sample_count, 16U);
}

// The expected value is |A - B| sqrt(a b) / n. A is the mean of the first a samples, where a is the largest power of
// two below n. B is the mean of the other b samples. Calls end before, at, after and across the counts at which parts
// are folded.
TEST_F(SplitIntoCalls, StandardErrorsAreThoseOfTheFilmsParts) {
    const auto standard_errors = [&] {
        Image errors(width * height * 3);
        const pt_image target = image_target(errors, PT_QUANTITY_STANDARD_ERROR);
        EXPECT_EQ(pt_readback(context(), &target), PT_OK) << pt_last_error(context());
        return errors;
    };
    const auto part_of = [&](uint32_t first, uint32_t count) {
        set_up_coursework(context(), 3);
        pt_render render = render_of(width, height, 3);
        render.first_sample = first;
        EXPECT_EQ(pt_set_render(context(), &render), PT_OK) << pt_last_error(context());
        accumulate(count);
        Image image(width * height * 3);
        readback(image);
        return image;
    };
    const auto deviation = [&](const Image &found, const Image &older, const Image &newer, double a, double b) {
        double worst = 0.0;
        for (std::size_t i = 0; i < found.size(); ++i) {
            const double scale = std::sqrt(a * b) / (a + b);
            const double expected = std::abs(double{older[i]} - double{newer[i]}) * scale;
            const double rounding = 0x1p-24 * ((double{older[i]} + double{newer[i]}) * scale + double{found[i]});
            worst = std::max(worst, std::abs(double{found[i]} - expected) / std::max(rounding, 1e-30));
        }
        return worst;
    };
    image_of({8});
    EXPECT_EQ(standard_errors(), Image(width * height * 3, std::numeric_limits<float>::infinity()));
    const struct {
        std::vector<uint32_t> calls;
        uint32_t older, newer;
    } cases[] = {{{9}, 8, 1}, {{5, 11}, 8, 8}, {{16, 1}, 16, 1}, {{40}, 32, 8}, {{1, 15, 16, 32}, 32, 32}};
    for (const auto &[calls, older, newer] : cases) {
        image_of(calls);
        const Image found = standard_errors();
        const Image first = part_of(0, older);
        const Image last = part_of(older, newer);
        EXPECT_LE(deviation(found, first, last, older, newer), 1.01) << older << " and " << newer;
        EXPECT_GT(deviation(found, part_of(0, older - 1), last, older, newer), 1e3) << older << " and " << newer;
    }
}

// Every sample is float32(0.1). Some drivers stop loops after 65,535 rounds.
TEST_F(SplitIntoCalls, NoSampleIsLostInLongRuns) {
    const Image image = image_inside_a_lamp(0.1F, 1U << 20);
    EXPECT_EQ(image, Image(image.size(), 0.1F));
    EXPECT_EQ(stats().sample_count, 1U << 20);
}

} // namespace
