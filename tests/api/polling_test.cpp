#include "tests/api/api_fixture.h"
#include "tests/api/every_call.h"
#include "tests/support/context_calls.h"
#include "tests/support/coursework_scene.h"
#include "tests/support/scene_of.h"
#include "tests/support/shared_context.h"

#include <pt/async.h>
#include <pt/film.h>

#include <gtest/gtest.h>

#include <string>
#include <utility>
#include <vector>

namespace api {

namespace {

constexpr uint32_t polled_width = 120;
constexpr uint32_t polled_height = 45;
constexpr uint64_t to_the_end = UINT64_MAX;
const std::string under_way =
    "samples are under way: call pt_poll until it does not return PT_PENDING, or call pt_cancel first";
const std::string not_under_way = "no samples are under way: call pt_start first";

using Pixels = std::vector<float>;
using Pattern = std::vector<uint64_t>;

struct Use {
    uint32_t devices;
    uint32_t submit_milliseconds;
    bool like_gpus;
};
constexpr Use all_uses[] = {{1, 50, false}, {1, 1, false}, {1, 1, true}, {1, 50, true}, {3, 1, false}, {2, 5, true}};

class PollingTest : public ApiTest {
protected:
    Context context_for(const Use &use) {
        Context made = create_context([&](pt_create_info &info) { info.submit_milliseconds = use.submit_milliseconds; },
                                      shared_by(use.devices, use.like_gpus));
        set_up(made.get());
        return made;
    }

    static void set_up(pt_context *on) { set_coursework(on, render_of(polled_width, polled_height, 3)); }

    static pt_result start(pt_context *on, uint32_t count, double target_error = 0.0) {
        const pt_accumulate_info info = accumulate_info(count, target_error);
        return pt_start(on, &info);
    }

    static pt_result end_of(pt_context *on, const Pattern &pattern = {to_the_end}) {
        double last = 0.0;
        for (std::size_t i = 0;; ++i) {
            double fraction = -1.0;
            const pt_result result = pt_poll(on, pattern[i % pattern.size()], &fraction);
            if (result < PT_OK)
                return result;
            EXPECT_TRUE(fraction >= last && fraction <= 1.0) << fraction << " after " << last;
            last = fraction;
            EXPECT_TRUE(result != PT_OK || fraction == 1.0) << fraction;
            if (result != PT_PENDING)
                return result;
        }
    }

    static void take(pt_context *on, uint32_t count, const Pattern &pattern = {to_the_end}) {
        ASSERT_EQ(start(on, count), PT_PENDING) << pt_last_error(on);
        ASSERT_EQ(end_of(on, pattern), PT_OK) << pt_last_error(on);
    }

    static Pixels image_of(pt_context *on) { return values_of(on, std::size_t{polled_width} * polled_height); }

    Pixels accumulated(uint32_t count) {
        set_up(context());
        accumulate(count);
        return image_of(context());
    }
};

TEST_F(PollingTest, AnyPatternOfPollsGivesTheBitsOfACallThatWaits) {
    const Pixels expected = accumulated(45);
    for (const Use &use : all_uses) {
        const Context on = context_for(use);
        for (const Pattern &pattern : {Pattern{0}, Pattern{to_the_end, 0, 1'000, 2'000'000}}) {
            set_up(on.get());
            take(on.get(), 30, pattern);
            EXPECT_NE(image_of(on.get()), expected) << "15 missing samples must show";
            take(on.get(), 15, pattern);
            EXPECT_EQ(image_of(on.get()), expected)
                << use.devices << " devices, " << use.submit_milliseconds << " ms, polls of " << pattern.back();
            EXPECT_EQ(stats_of(on.get()).sample_count, 45U);
        }
    }
}

TEST_F(PollingTest, CancellingKeepsWholeSamplesAndTheContextGoesOn) {
    for (const Use &use : {Use{1, 1, false}, Use{1, 1, true}, Use{3, 1, true}}) {
        const Context on = context_for(use);
        int cancelled = 0;
        uint32_t done = 0;
        for (int polls = 0; done < 24; ++polls) {
            pt_result result = start(on.get(), 24 - done);
            for (int i = 0; i < polls && result == PT_PENDING; ++i)
                result = pt_poll(on.get(), 100'000, nullptr);
            if (result == PT_PENDING) {
                EXPECT_EQ(pt_cancel(on.get()), PT_OK);
                EXPECT_EQ(pt_cancel(on.get()), PT_OK) << "again";
                result = end_of(on.get());
            }
            ASSERT_GE(result, PT_OK) << pt_last_error(on.get());
            const uint32_t before = done;
            done = stats_of(on.get()).sample_count;
            EXPECT_GE(done, before);
            EXPECT_EQ(result, done < 24 ? PT_CANCELLED : PT_OK);
            cancelled += result == PT_CANCELLED;
            if (done == 0)
                continue;
            ASSERT_EQ(image_of(on.get()), accumulated(done)) << done << " samples";
            if (done < 24 && polls % 3 == 2) {
                accumulate_on(on.get(), 1);
                ++done;
            }
        }
        EXPECT_TRUE(cancelled > 1 || !is_on_cpu(on.get())) << cancelled;
    }
}

// The error is checked at the same sample counts whether or not calls are cancelled.
TEST_F(PollingTest, ATargetIsReachedAtTheSameCount) {
    constexpr uint32_t most = 4096;
    constexpr double target = 0.1;
    for (const bool like_gpus : {false, true}) {
        const Context waits = context_for({1, 50, like_gpus});
        const pt_accumulate_info info = accumulate_info(most, target);
        ASSERT_EQ(pt_accumulate(waits.get(), &info), PT_TARGET_REACHED) << pt_last_error(waits.get());
        const uint32_t reached = stats_of(waits.get()).sample_count;
        EXPECT_GT(reached, 16U);
        for (const auto &[use, cancels] :
             {std::pair{Use{1, 1, like_gpus}, false}, {Use{2, 5, like_gpus}, false}, {Use{1, 1, like_gpus}, true}}) {
            const Context on = context_for(use);
            ASSERT_EQ(start(on.get(), 7, target), PT_PENDING) << pt_last_error(on.get());
            EXPECT_EQ(end_of(on.get(), {0}), PT_OK) << pt_last_error(on.get());
            pt_result result = PT_CANCELLED;
            int cancelled = 0;
            for (; result == PT_CANCELLED; ++cancelled) {
                result = start(on.get(), most, target);
                for (int i = 0; cancels && i < 3 && result == PT_PENDING; ++i)
                    result = pt_poll(on.get(), 500'000, nullptr);
                if (result != PT_PENDING)
                    break;
                EXPECT_EQ(cancels ? pt_cancel(on.get()) : PT_OK, PT_OK);
                result = end_of(on.get(), {0, 300'000});
            }
            ASSERT_EQ(result, PT_TARGET_REACHED) << pt_last_error(on.get());
            EXPECT_TRUE(!cancels || cancelled > 2 || !is_on_cpu(on.get())) << cancelled;
            EXPECT_EQ(stats_of(on.get()).sample_count, reached);
            EXPECT_EQ(image_of(on.get()), image_of(waits.get()));
            EXPECT_EQ(start(on.get(), most, target), PT_TARGET_REACHED) << "it is reached already";
            EXPECT_EQ(pt_poll(on.get(), 0, nullptr), PT_ERROR_INVALID_STATE) << "nothing was begun";
        }
    }
}

TEST_F(PollingTest, OtherCallsAreRefusedWhileSamplesAreUnderWay) {
    const Pixels expected = accumulated(40);
    const Context on = context_for({1, 1, false});
    ASSERT_EQ(start(on.get(), 40), PT_PENDING) << pt_last_error(on.get());
    Outcomes outcomes = outcomes_of_every_call(on.get());
    EXPECT_TRUE(outcomes.at("pt_get_context_device").starts_with("PT_OK")) << outcomes.at("pt_get_context_device");
    outcomes.at("pt_get_context_device") = "PT_ERROR_INVALID_STATE: " + under_way;
    expect_every_call(outcomes, "PT_ERROR_INVALID_STATE: " + under_way);
    uint64_t size = 0;
    EXPECT_EQ(pt_save_film(on.get(), nullptr, &size), PT_ERROR_INVALID_STATE);
    EXPECT_EQ(pt_add_film(on.get(), &size, sizeof size), PT_ERROR_INVALID_STATE);
    EXPECT_STREQ(pt_last_error(on.get()), under_way.c_str());
    EXPECT_EQ(pt_get_broken_rule(on.get(), 0, nullptr), 0U);
    EXPECT_EQ(end_of(on.get()), PT_OK) << pt_last_error(on.get());
    EXPECT_EQ(image_of(on.get()), expected) << "they have changed nothing";
}

TEST_F(PollingTest, NothingIsPolledWithoutAStart) {
    const auto expect_nothing = [&] {
        double fraction = 0.25;
        expect_failure(pt_poll(context(), 0, &fraction), PT_ERROR_INVALID_STATE, not_under_way);
        EXPECT_EQ(fraction, 0.25) << "a call that fails writes nothing";
        expect_failure(pt_cancel(context()), PT_ERROR_INVALID_STATE, not_under_way);
    };
    expect_nothing();
    expect_failure(start(context(), 1), PT_ERROR_INVALID_STATE, "no scene: call pt_set_scene first");
    set_all();
    take(context(), 3);
    expect_nothing();
    pt_accumulate_info info = accumulate_info(1);
    info.progress = [](void *, double) -> int32_t { return 0; };
    expect_failure(pt_start(context(), &info), PT_ERROR_INVALID_ARGUMENT,
                   "accumulate.progress = a function: must be NULL for pt_start; pt_poll reports the progress");
    expect_nothing();
    expect_image(3);
}

TEST_F(PollingTest, ACallbackMayNotPollButCancel) {
    set_all();
    const auto cancel = [](void *user, double) -> int32_t {
        auto *const on = static_cast<pt_context *>(user);
        EXPECT_EQ(pt_poll(on, 0, nullptr), PT_ERROR_INVALID_STATE);
        EXPECT_STREQ(pt_last_error(on), "called from a callback of its own context");
        EXPECT_EQ(pt_cancel(on), PT_OK);
        return 0;
    };
    const pt_accumulate_info info = accumulate_info(UINT32_MAX, 0.0, cancel, context());
    EXPECT_EQ(pt_accumulate(context(), &info), PT_CANCELLED) << message();
    accumulate(1); // the cancellation counts once
}

TEST_F(PollingTest, AContextMayBeDestroyedAtAnyTime) {
    int polls = 0;
    for (const Use &use : all_uses) {
        const Context on = context_for(use);
        ASSERT_EQ(start(on.get(), 1'000'000), PT_PENDING) << pt_last_error(on.get());
        for (int i = 0; i < polls; ++i)
            EXPECT_EQ(pt_poll(on.get(), 1'000'000, nullptr), PT_PENDING) << pt_last_error(on.get());
        polls = (polls + 1) % 3;
    }
}

} // namespace

} // namespace api
