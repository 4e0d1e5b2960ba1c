#include "lib/film/error_estimate.h"
#include "shaders/gpu_layout.h"
#include "tests/support/context_calls.h"
#include "tests/support/context_fixture.h"
#include "tests/support/coursework_scene.h"
#include "tests/support/render_image.h"
#include "tests/support/scene_of.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdint>
#include <vector>

namespace {

constexpr uint32_t width = 200;
constexpr uint32_t height = 75;

using Image = std::vector<float>;

class SplitIntoCalls : public ContextFixture {
protected:
    void set_up() { set_coursework(context(), render_of(width, height, 3)); }

    Image image_of(const std::vector<uint32_t> &calls) {
        set_up();
        for (const uint32_t samples : calls)
            accumulate(samples);
        return values_of(context(), std::size_t{width} * height);
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
    set_up();
    pt_accumulate_info until_target = accumulate_info(most, target);
    until_target.sampling = PT_SAMPLING_UNIFORM;
    ASSERT_EQ(pt_accumulate(context(), &until_target), PT_TARGET_REACHED) << pt_last_error(context());
    const pt_stats reached = stats();
    EXPECT_GT(reached.sample_count, 16U);
    EXPECT_LT(reached.sample_count, most);
    EXPECT_LE(error().relative_rmse_high, target);

    ASSERT_EQ(pt_accumulate(context(), &until_target), PT_TARGET_REACHED);
    EXPECT_EQ(stats().sample_count, reached.sample_count);

    set_up();
    uint64_t before = pt::next_check(0);
    while (pt::next_check(before) < reached.sample_count)
        before = pt::next_check(before);
    accumulate(static_cast<uint32_t>(before));
    EXPECT_GT(error().relative_rmse_high, target);
}

// Every sample is float32(0.1). Some drivers stop loops after 65,535 rounds.
TEST_F(SplitIntoCalls, NoSampleIsLostInLongRuns) {
    const pt_material material{{0, 0, 0}, {0, 0, 0}, {0.1F, 0.1F, 0.1F}, 0, 0};
    const pt_sphere around{{0, 0, 0}, 50, {0, 0, 0}, 0, 0};
    const pt_scene scene = scene_of({&material, 1}, {&around, 1}, {});
    const Image image = render_image(context(), scene, CourseworkScene::camera(), render_of(8, 8, 1), 1U << 20);
    EXPECT_EQ(image, Image(image.size(), 0.1F));
    EXPECT_EQ(stats().sample_count, 1U << 20);
}

} // namespace
