// Films without a context beside the contexts that they came from: the same bits.
#include "tests/support/context_calls.h"
#include "tests/support/context_fixture.h"
#include "tests/support/coursework_scene.h"
#include "tests/support/image_target.h"
#include "tests/support/shared_context.h"

#include <pt/film.h>

#include <algorithm>
#include <cstdint>
#include <memory>
#include <random>
#include <vector>

namespace {

constexpr uint32_t value_width = 37;
constexpr uint32_t value_height = 22;

class FilmValue : public ContextFixture {
protected:
    using Bytes = std::vector<char>;

    void take(uint32_t first, uint32_t count, uint32_t first_row = 0, uint32_t row_count = 0) {
        pt_render render = render_of(value_width, value_height, 3);
        render.first_sample = first;
        render.first_row = first_row;
        render.row_count = row_count;
        const CourseworkScene coursework;
        const pt_scene scene = coursework.scene();
        const pt_camera camera = CourseworkScene::camera();
        set_picture(context(), scene, camera, render);
        const pt_accumulate_info info{sizeof info, count, nullptr, nullptr, 0, 0, 0, nullptr, 0, 0};
        ASSERT_EQ(pt_accumulate(context(), &info), PT_OK) << pt_last_error(context());
    }

    Bytes part(uint32_t first, uint32_t count, uint32_t first_row = 0, uint32_t row_count = 0) {
        take(first, count, first_row, row_count);
        return film_of(context());
    }

    static Bytes bytes_of(const pt_film *value) {
        uint64_t size = 0;
        EXPECT_EQ(pt_write_film(value, nullptr, &size), PT_OK) << pt_last_error(nullptr);
        Bytes bytes(size);
        EXPECT_EQ(pt_write_film(value, bytes.data(), &size), PT_OK) << pt_last_error(nullptr);
        return bytes;
    }

    static std::unique_ptr<pt_film, void (*)(pt_film *)> sum_of(const std::vector<Bytes> &parts) {
        pt_film *sum = nullptr;
        EXPECT_EQ(pt_open_film(parts.front().data(), parts.front().size(), &sum), PT_OK) << pt_last_error(nullptr);
        for (std::size_t i = 1; i < parts.size(); ++i)
            EXPECT_EQ(pt_merge_film(sum, parts[i].data(), parts[i].size()), PT_OK) << pt_last_error(nullptr);
        return {sum, &pt_close_film};
    }
};

TEST_F(FilmValue, PartsAddUpToTheContextsFilmInAnyOrder) {
    const Bytes whole = part(0, 100);
    std::vector<Bytes> parts;
    const uint32_t ends[] = {0, 5, 32, 33, 70, 100};
    for (std::size_t i = 1; i < std::size(ends); ++i)
        parts.push_back(part(ends[i - 1], ends[i] - ends[i - 1]));
    std::mt19937 random(1);
    for (int round = 0; round < 10; ++round) {
        std::ranges::shuffle(parts, random);
        EXPECT_TRUE(bytes_of(sum_of(parts).get()) == whole);
    }
    parts.pop_back();
    EXPECT_FALSE(bytes_of(sum_of(parts).get()) == whole);
}

// Rows that were rendered apart are one tile again.
TEST_F(FilmValue, RowsAddUpToo) {
    const Bytes whole = part(0, 12);
    EXPECT_TRUE(bytes_of(sum_of({part(0, 12, 9, 13), part(0, 12, 0, 9)}).get()) == whole);
    EXPECT_TRUE(bytes_of(sum_of({part(0, 7, 9, 13), part(0, 12, 0, 9), part(7, 5, 9, 13)}).get()) == whole);
}

TEST_F(FilmValue, ShowsWhatTheContextShows) {
    take(0, 100);
    const auto value = sum_of({film_of(context())});
    for (const uint32_t quantity : {PT_QUANTITY_RADIANCE, PT_QUANTITY_STANDARD_ERROR})
        for (const uint32_t format : {PT_FORMAT_RGB32F, PT_FORMAT_RGBA32F, PT_FORMAT_RGBA16F}) {
            std::vector<float> here(std::size_t{4} * value_width * value_height, -1.0F);
            std::vector<float> there = here;
            pt_image image = image_target(here, quantity);
            image.format = format;
            ASSERT_EQ(pt_readback(context(), &image), PT_OK) << pt_last_error(context());
            image.data = there.data();
            ASSERT_EQ(pt_read_film(value.get(), &image), PT_OK) << pt_last_error(nullptr);
            EXPECT_TRUE(here == there) << quantity << ' ' << format;
        }
    pt_stats kept{};
    kept.struct_size = sizeof kept;
    ASSERT_EQ(pt_get_film_stats(value.get(), &kept), PT_OK) << pt_last_error(nullptr);
    EXPECT_EQ(kept.sample_count, stats().sample_count);
    EXPECT_EQ(kept.rejected_samples, stats().rejected_samples);
    using Error = pt_error_estimate;
    Error kept_error{};
    kept_error.struct_size = sizeof kept_error;
    ASSERT_EQ(pt_get_film_error_estimate(value.get(), &kept_error), PT_OK) << pt_last_error(nullptr);
    const Error rendered = error();
    EXPECT_EQ(kept_error.uncertain, rendered.uncertain);
    for (double Error::*const each : {&Error::rmse, &Error::rmse_low, &Error::rmse_high, &Error::relative_rmse,
                                      &Error::relative_rmse_low, &Error::relative_rmse_high})
        // A GPU sums up the squares of 16 tiles, at most 3072, in float32: each sum is within 3072 x 2^-24.
        EXPECT_NEAR(kept_error.*each, rendered.*each, 2e-4 * rendered.*each);
}

} // namespace
