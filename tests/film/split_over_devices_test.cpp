#include "tests/support/context_calls.h"
#include "tests/support/context_fixture.h"
#include "tests/support/coursework_scene.h"
#include "tests/support/image_target.h"
#include "tests/support/scene_of.h"
#include "tests/support/shared_context.h"

#include <gtest/gtest.h>
#include <pt/film.h>

#include <vector>

namespace {

constexpr uint32_t shared_width = 120;
constexpr uint32_t shared_height = 45;

using Image = std::vector<float>;

class SplitOverDevices : public ContextFixture {
protected:
    Context context_on(uint32_t device_count, uint32_t submit_milliseconds, bool like_gpus = false) {
        return create_context([&](pt_create_info &info) { info.submit_milliseconds = submit_milliseconds; },
                              shared_by(device_count, like_gpus));
    }

    static void set_up(pt_context *on, uint32_t first_row = 0, uint32_t row_count = 0, uint32_t first_sample = 0) {
        pt_render render = render_of(shared_width, shared_height, 3);
        render.first_sample = first_sample;
        render.first_row = first_row;
        render.row_count = row_count;
        set_coursework(on, render);
    }

    static Image image_of(pt_context *on, uint32_t rows = shared_height, uint32_t quantity = PT_QUANTITY_RADIANCE) {
        return values_of(on, std::size_t{shared_width} * rows, quantity);
    }

    pt_error_estimate error_of_one_gpu(uint32_t samples) {
        const Context alone = context_on(1, 50, true);
        set_up(alone.get());
        accumulate_on(alone.get(), samples);
        return error_of(alone.get());
    }
};

TEST_F(SplitOverDevices, SeveralDevicesGiveTheBitsOfOne) {
    const Context alone = context_on(1, 50);
    set_up(alone.get());
    accumulate_on(alone.get(), 77);
    const Image expected = image_of(alone.get());
    const Image expected_error = image_of(alone.get(), shared_height, PT_QUANTITY_STANDARD_ERROR);
    const pt_error_estimate expected_errors[] = {error_of(alone.get()), error_of_one_gpu(77)};
    set_up(alone.get(), 0, 0, 50);
    accumulate_on(alone.get(), 27);
    const std::vector<char> rest = film_of(alone.get());
    for (const auto &[submit_milliseconds, like_gpus] : {std::pair{1U, false}, {50U, false}, {5U, true}}) {
        const Context shared = context_on(3, submit_milliseconds, like_gpus);
        set_up(shared.get());
        accumulate_on(shared.get(), 50);
        EXPECT_NE(image_of(shared.get()), expected) << "27 missing samples must show";
        if (submit_milliseconds == 50)
            EXPECT_EQ(pt_add_film(shared.get(), rest.data(), rest.size()), PT_OK) << pt_last_error(shared.get());
        else
            accumulate_on(shared.get(), 27);
        EXPECT_EQ(image_of(shared.get()), expected);
        EXPECT_EQ(image_of(shared.get(), shared_height, PT_QUANTITY_STANDARD_ERROR), expected_error);
        const pt_stats stats = stats_of(shared.get());
        EXPECT_EQ(stats.device_count, 3U);
        EXPECT_EQ(stats.sample_count, 77U);
        EXPECT_EQ(error_of(shared.get()).relative_rmse, expected_errors[like_gpus ? 1 : 0].relative_rmse);
        EXPECT_EQ(error_of(shared.get()).rmse_high, expected_errors[like_gpus ? 1 : 0].rmse_high);
        EXPECT_GE(stats.device_bytes, uint64_t{3} * 112 * shared_width * shared_height) << "each has a film";
    }
}

TEST_F(SplitOverDevices, RowsAreThoseOfTheWholeImage) {
    set_up(context());
    accumulate(16);
    const Image whole = image_of(context());
    const auto expected = [&](uint32_t first_row, uint32_t rows) {
        const auto begin = whole.begin() + std::ptrdiff_t{shared_width} * first_row * 3;
        return Image(begin, begin + std::ptrdiff_t{shared_width} * rows * 3);
    };
    for (const auto &[first_row, row_count] : {std::pair{0U, 7U}, {7U, 30U}, {37U, 0U}, {44U, 1U}}) {
        const uint32_t rows = row_count == 0 ? shared_height - first_row : row_count;
        set_up(context(), first_row, row_count);
        accumulate(16);
        EXPECT_EQ(image_of(context(), rows), expected(first_row, rows)) << "rows from " << first_row;
        EXPECT_NE(image_of(context(), rows), expected(first_row == 0 ? 1 : first_row - 1, rows));
    }
}

TEST_F(SplitOverDevices, LargeFilmsMeetInBands) {
    constexpr uint32_t width = 1060;
    constexpr uint32_t height = 500;
    Image images[2];
    Image parts[2];
    pt_error_estimate errors[2];
    for (const uint32_t devices : {1U, 2U}) {
        const Context shared = context_on(devices, 50, true);
        set_coursework(shared.get(), render_of(width, height, 1));
        accumulate_on(shared.get(), 17);
        errors[devices - 1] = error_of(shared.get());
        images[devices - 1] = values_of(shared.get(), std::size_t{width} * height);
        Image &part = parts[devices - 1];
        part.resize(std::size_t{30} * 200 * 3);
        pt_image rectangle = image_target(part);
        set_part(rectangle, {700, 190, 30, 200});
        EXPECT_EQ(pt_readback(shared.get(), &rectangle), PT_OK) << pt_last_error(shared.get());
    }
    EXPECT_EQ(images[0], images[1]);
    EXPECT_EQ(parts[0], parts[1]);
    EXPECT_NE(parts[0], Image(parts[0].size()));
    EXPECT_EQ(errors[0].relative_rmse, errors[1].relative_rmse);
    EXPECT_EQ(errors[0].rmse_high, errors[1].rmse_high);
}

} // namespace
