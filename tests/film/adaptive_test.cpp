#include "tests/support/context_calls.h"
#include "tests/support/context_fixture.h"
#include "tests/support/coursework_scene.h"
#include "tests/support/shared_context.h"

#include <pt/film.h>

#include <gtest/gtest.h>

#include <cstddef>
#include <map>
#include <random>
#include <string>
#include <vector>

namespace {

constexpr uint32_t uneven_width = 75; // not a multiple of the tile size
constexpr uint32_t uneven_height = 44;
constexpr double uneven_target = 0.015;
constexpr uint32_t no_limit = 1U << 20;

using Values = std::vector<float>;
using Bytes = std::vector<char>;

class AdaptiveTest : public ContextFixture {
protected:
    Context create_fixtures_context() override { return context_on(1); }

    Context context_on(uint32_t device_count, uint32_t submit_milliseconds = 50, bool like_gpus = false) {
        return create_context([&](pt_create_info &info) { info.submit_milliseconds = submit_milliseconds; },
                              shared_by(device_count, like_gpus, like_gpus ? 16 : 0));
    }

    static void begin(pt_context *on) { set_coursework(on, render_of(uneven_width, uneven_height, 2)); }

    static pt_result take(pt_context *on, uint32_t samples, double target_error, uint32_t sampling = PT_SAMPLING_BEST,
                          uint32_t limit = 0) {
        pt_accumulate_info info = accumulate_info(samples, target_error);
        info.sampling = sampling;
        info.sample_limit = limit;
        return pt_accumulate(on, &info);
    }

    static Values values(pt_context *on, uint32_t quantity = PT_QUANTITY_RADIANCE) {
        return values_of(on, std::size_t{uneven_width} * uneven_height, quantity);
    }

    static Bytes film_on_target(pt_context *on) {
        begin(on);
        EXPECT_EQ(take(on, no_limit, uneven_target), PT_TARGET_REACHED) << pt_last_error(on);
        return film_of(on);
    }
};

TEST_F(AdaptiveTest, EachTileHasTheBitsOfAnEvenFilm) {
    for (const auto &[device_count, like_gpus] : {std::pair{1U, false}, {1U, true}, {3U, true}}) {
        const Context uneven = context_on(device_count, 50, like_gpus);
        begin(uneven.get());
        ASSERT_EQ(take(uneven.get(), no_limit, uneven_target), PT_TARGET_REACHED);
        const Values counts = values(uneven.get(), PT_QUANTITY_SAMPLE_COUNT);
        const Values radiance = values(uneven.get());
        const Values error = values(uneven.get(), PT_QUANTITY_STANDARD_ERROR);
        std::map<uint32_t, std::size_t> pixels;
        for (std::size_t i = 0; i < counts.size(); i += 3)
            ++pixels[static_cast<uint32_t>(counts[i])];
        EXPECT_GE(pixels.size(), 3U);
        double total = 0.0;
        const Context even = context_on(1);
        for (const auto &[count, pixel_count] : pixels) {
            begin(even.get());
            ASSERT_EQ(take(even.get(), count, 0.0), PT_OK);
            const Values expected = values(even.get());
            const Values expected_error = values(even.get(), PT_QUANTITY_STANDARD_ERROR);
            for (std::size_t i = 0; i < counts.size(); ++i)
                if (counts[i] == static_cast<float>(count)) {
                    ASSERT_EQ(radiance[i], expected[i]) << count << " samples, value " << i;
                    ASSERT_EQ(error[i], expected_error[i]) << count << " samples, value " << i;
                }
            total += static_cast<double>(count) * static_cast<double>(pixel_count);
        }
        const pt_stats stats = stats_of(uneven.get());
        EXPECT_EQ(stats.sample_count, pixels.begin()->first);
        EXPECT_EQ(stats.max_sample_count, pixels.rbegin()->first);
        EXPECT_DOUBLE_EQ(stats.mean_sample_count, total / (uneven_width * uneven_height));
        EXPECT_LE(error_of(uneven.get()).relative_rmse_high, uneven_target);
    }
}

TEST_F(AdaptiveTest, TakesFewerSamples) {
    begin(context());
    ASSERT_EQ(take(context(), no_limit, uneven_target, PT_SAMPLING_ADAPTIVE), PT_TARGET_REACHED);
    const double adaptive = stats_of(context()).mean_sample_count;
    begin(context());
    ASSERT_EQ(take(context(), no_limit, uneven_target, PT_SAMPLING_UNIFORM), PT_TARGET_REACHED);
    const pt_stats uniform = stats_of(context());
    EXPECT_EQ(uniform.sample_count, uniform.max_sample_count);
    EXPECT_LT(adaptive, 0.9 * uniform.mean_sample_count);
}

TEST_F(AdaptiveTest, SplitsAndResumesChangeNoBit) {
    std::mt19937 generator(1818);
    struct Stopper {
        std::mt19937 &generator;
        bool has_stopped = false;
        static int32_t progress(void *user, double) {
            auto &[generator, has_stopped] = *static_cast<Stopper *>(user);
            EXPECT_FALSE(has_stopped) << "called again after it asked to stop";
            has_stopped = generator() % 4 == 0;
            return has_stopped ? 1 : 0;
        }
    };
    for (const bool like_gpus : {false, true}) {
        const Context first = context_on(1, 2, like_gpus);
        const Context second = context_on(2, 1, like_gpus);
        const Bytes expected = film_on_target(first.get());
        for (int split = 0; split < 3; ++split) {
            pt_context *on = first.get();
            pt_context *other = second.get();
            begin(on);
            for (pt_result result = PT_OK; result != PT_TARGET_REACHED;) {
                Stopper stopper{generator};
                const auto samples = static_cast<uint32_t>(generator() % 60);
                pt_accumulate_info info = accumulate_info(samples, uneven_target, &Stopper::progress, &stopper);
                info.sample_limit = no_limit;
                if (generator() % 2 == 0)
                    info.progress = nullptr;
                result = pt_accumulate(on, &info);
                ASSERT_GE(result, PT_OK) << pt_last_error(on);
                if (generator() % 3 == 0 && stats_of(on).mean_sample_count > 0.0) {
                    const Bytes so_far = film_of(on);
                    begin(other);
                    ASSERT_EQ(pt_add_film(other, so_far.data(), so_far.size()), PT_OK) << pt_last_error(other);
                    ASSERT_EQ(film_of(other), so_far);
                    std::swap(on, other);
                }
            }
            ASSERT_EQ(film_of(on), expected) << "split " << split;
        }
    }
}

TEST_F(AdaptiveTest, TheMostSamplesAreThoseOfAPixel) {
    const Bytes expected = film_on_target(context());
    begin(context());
    EXPECT_EQ(take(context(), 50, uneven_target, PT_SAMPLING_BEST, no_limit), PT_OK);
    EXPECT_EQ(stats_of(context()).max_sample_count, 50U);
    const Bytes held_up = film_of(context());
    EXPECT_EQ(take(context(), 0, uneven_target, PT_SAMPLING_BEST, no_limit), PT_OK);
    EXPECT_EQ(film_of(context()), held_up);
    EXPECT_EQ(take(context(), no_limit, uneven_target), PT_TARGET_REACHED);
    EXPECT_EQ(film_of(context()), expected);
    EXPECT_EQ(take(context(), 1, uneven_target), PT_TARGET_REACHED) << "at once";
    EXPECT_EQ(take(context(), 0, uneven_target), PT_TARGET_REACHED);
    EXPECT_EQ(film_of(context()), expected);
}

TEST_F(AdaptiveTest, WithoutATargetAllPixelsTakeAsManyMore) {
    film_on_target(context());
    const Values before = values(context(), PT_QUANTITY_SAMPLE_COUNT);
    ASSERT_EQ(take(context(), 9, 0.0), PT_OK);
    const Values after = values(context(), PT_QUANTITY_SAMPLE_COUNT);
    for (std::size_t i = 0; i < before.size(); ++i)
        ASSERT_EQ(after[i], before[i] + 9.0F);
}

TEST_F(AdaptiveTest, NeedsATarget) {
    begin(context());
    EXPECT_EQ(take(context(), 1, 0.0, PT_SAMPLING_ADAPTIVE), PT_ERROR_INVALID_ARGUMENT);
    EXPECT_NE(std::string(pt_last_error(context())).find("sampling"), std::string::npos) << pt_last_error(context());
    EXPECT_EQ(take(context(), 1, 0.1, PT_SAMPLING_ADAPTIVE + 1), PT_ERROR_INVALID_ARGUMENT);
    EXPECT_EQ(take(context(), 1, 0.0, PT_SAMPLING_BEST, 2), PT_ERROR_INVALID_ARGUMENT);
    EXPECT_NE(std::string(pt_last_error(context())).find("sample_limit"), std::string::npos)
        << pt_last_error(context());
}

} // namespace
