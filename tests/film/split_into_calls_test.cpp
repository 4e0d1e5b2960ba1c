#include "lib/film/error_estimate.h"
#include "shaders/gpu_layout.h"
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

// The long calls exceed the limits of a dispatch and of the table of points.
TEST_F(SplitIntoCalls, LongCallsHaveTheBitsOfShortOnes) {
    const Context patient = create_context([](pt_create_info &info) { info.submit_milliseconds = 1000; });
    for (const uint32_t sampler : {PT_SAMPLER_RANDOM, PT_SAMPLER_SOBOL}) {
        const auto image_in_calls = [&](uint32_t count, uint32_t most) {
            pt_render render = render_of(3, 1, 3);
            render.sampler = sampler;
            set_coursework(patient.get(), render);
            for (uint32_t left = count; left > 0; left -= std::min(left, most))
                accumulate_on(patient.get(), std::min(left, most));
            EXPECT_EQ(stats_of(patient.get()).rejected_samples, 0U);
            return values_of(patient.get(), 3);
        };
        for (const uint32_t more : {0U, 1U, 2U}) {
            const uint32_t count = 4 * pt::gpu::FILM_MAX_GATHERED + more;
            const Image at_once = image_in_calls(count, count);
            EXPECT_EQ(image_in_calls(count, 211), at_once) << sampler << ", " << more;
            EXPECT_NE(image_in_calls(count - 1, 211), at_once) << "a missing sample must show";
        }
    }
}

TEST_F(SplitIntoCalls, TheTargetErrorIsReachedAtTheFirstCheckThatSaysSo) {
    constexpr uint32_t most = 4096;
    constexpr double target = 0.07;
    set_up_coursework(context(), 3);
    pt_accumulate_info until_target = accumulate_info(most, target);
    until_target.sampling = PT_SAMPLING_UNIFORM;
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
        pt_accumulate_info info = accumulate_info(8, target);
        info.sampling = PT_SAMPLING_UNIFORM;
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
