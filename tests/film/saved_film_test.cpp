#include "lib/base/digest.h"
#include "tests/support/context_calls.h"
#include "tests/support/context_fixture.h"
#include "tests/support/coursework_scene.h"
#include "tests/support/image_target.h"
#include "tests/support/sized.h"

#include <pt/film.h>

#include <algorithm>
#include <cstdint>
#include <cstring>
#include <functional>
#include <memory>
#include <random>
#include <span>
#include <string>
#include <vector>

namespace {

using Bytes = std::vector<char>;

constexpr uint32_t film_width = 21;
constexpr uint32_t film_height = 14;

struct Picture {
    std::vector<float> radiance, standard_error;
    pt_stats stats;
    pt_error_estimate error;
    Bytes film;

    bool operator==(const Picture &other) const {
        return radiance == other.radiance && standard_error == other.standard_error &&
               stats.sample_count == other.stats.sample_count && error.rmse == other.error.rmse &&
               error.relative_rmse_high == other.error.relative_rmse_high && film == other.film;
    }
};

class SavedFilm : public ContextFixture {
protected:
    static pt_render settings(uint32_t first_sample) {
        pt_render render = render_of(film_width, film_height, 3);
        render.first_sample = first_sample;
        return render;
    }

    static void set_up(pt_context *context, const pt_render &render, pt_camera camera = CourseworkScene::camera()) {
        set_coursework(context, render, camera);
    }

    static Bytes film_of(pt_context *context) {
        uint64_t size = 0;
        EXPECT_EQ(pt_save_film(context, nullptr, &size), PT_OK) << pt_last_error(context);
        Bytes bytes(size + 7, 'x');
        size = bytes.size();
        EXPECT_EQ(pt_save_film(context, bytes.data(), &size), PT_OK) << pt_last_error(context);
        EXPECT_EQ(Bytes(bytes.end() - 7, bytes.end()), Bytes(7, 'x')) << "wrote beyond its size";
        bytes.resize(size);
        return bytes;
    }

    static pt_result add(pt_context *context, const Bytes &film) {
        return pt_add_film(context, film.data(), film.size());
    }

    static std::unique_ptr<pt_film, void (*)(pt_film *)> sum_of(const std::vector<Bytes> &parts) {
        pt_film *sum = nullptr;
        EXPECT_EQ(pt_open_film(parts.front().data(), parts.front().size(), &sum), PT_OK) << pt_last_error(nullptr);
        for (std::size_t i = 1; i < parts.size(); ++i)
            EXPECT_EQ(pt_merge_film(sum, parts[i].data(), parts[i].size()), PT_OK) << pt_last_error(nullptr);
        return {sum, &pt_close_film};
    }

    static Bytes bytes_of(const pt_film *value) {
        uint64_t size = 0;
        EXPECT_EQ(pt_write_film(value, nullptr, &size), PT_OK) << pt_last_error(nullptr);
        Bytes bytes(size);
        EXPECT_EQ(pt_write_film(value, bytes.data(), &size), PT_OK) << pt_last_error(nullptr);
        return bytes;
    }

    static void seal(Bytes &film) {
        const std::size_t checked = film.size() - sizeof(uint64_t);
        const uint64_t checksum = pt::checksum(std::as_bytes(std::span(film).first(checked)));
        std::memcpy(&film[checked], &checksum, sizeof checksum);
    }

    static Picture picture_of(pt_context *context, uint32_t rows = film_height) {
        Picture picture;
        const auto read = [&](std::vector<float> &values, uint32_t quantity) {
            values.resize(std::size_t{3} * film_width * rows);
            const pt_image image = image_target(values, quantity);
            EXPECT_EQ(pt_readback(context, &image), PT_OK) << pt_last_error(context);
        };
        read(picture.radiance, PT_QUANTITY_RADIANCE);
        read(picture.standard_error, PT_QUANTITY_STANDARD_ERROR);
        picture.stats = stats_of(context);
        picture.error = error_of(context);
        picture.film = film_of(context);
        return picture;
    }

    Bytes part(uint32_t first, uint32_t end) {
        set_up(context(), settings(first));
        accumulate_on(context(), end - first);
        return film_of(context());
    }

    Picture whole(uint32_t count) {
        set_up(context(), settings(0));
        accumulate_on(context(), count);
        return picture_of(context());
    }
};

TEST_F(SavedFilm, PartsAddUpToTheWholeInAnyOrder) {
    const Picture expected = whole(150);
    const uint32_t ends[] = {0, 3, 7, 30, 64, 65, 100, 128, 150};
    std::vector<Bytes> parts;
    for (std::size_t i = 1; i < std::size(ends); ++i)
        parts.push_back(part(ends[i - 1], ends[i]));
    std::mt19937 random(1);
    for (int round = 0; round < 20; ++round) {
        std::ranges::shuffle(parts, random);
        set_up(context(), settings(0));
        for (std::size_t i = 0; i < parts.size(); ++i) {
            ASSERT_EQ(add(context(), parts[i]), PT_OK) << pt_last_error(context());
            ASSERT_EQ(picture_of(context()) == expected, i + 1 == parts.size()) << "order " << round;
        }
        EXPECT_TRUE(bytes_of(sum_of(parts).get()) == expected.film) << "order " << round;
    }
}

TEST_F(SavedFilm, AsAValueShowsWhatTheContextShows) {
    const Bytes film = part(0, 100);
    const auto value = sum_of({film});
    for (const uint32_t quantity : {PT_QUANTITY_RADIANCE, PT_QUANTITY_STANDARD_ERROR})
        for (const uint32_t format : {PT_FORMAT_RGB32F, PT_FORMAT_RGBA32F, PT_FORMAT_RGBA16F}) {
            std::vector<float> here(std::size_t{4} * film_width * film_height, -1.0F);
            std::vector<float> there = here;
            pt_image image = image_target(here, quantity);
            image.format = format;
            ASSERT_EQ(pt_readback(context(), &image), PT_OK) << pt_last_error(context());
            image.data = there.data();
            ASSERT_EQ(pt_read_film(value.get(), &image), PT_OK) << pt_last_error(nullptr);
            EXPECT_TRUE(here == there) << quantity << ' ' << format;
        }
    auto kept = sized<pt_stats>();
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
        // A GPU sums up to 3072 squares of 16 tiles in float32, with an error of 3072 x 2^-24.
        EXPECT_NEAR(kept_error.*each, rendered.*each, 2e-4 * rendered.*each);
}

TEST_F(SavedFilm, AContextGoesOnWithTheSamplesThatAreMissing) {
    const Picture expected = whole(100);
    const Bytes middle = part(20, 50);
    const Bytes late = part(70, 90);
    set_up(context(), settings(0));
    accumulate_on(context(), 10);
    ASSERT_EQ(add(context(), late), PT_OK) << pt_last_error(context());
    accumulate_on(context(), 7);
    ASSERT_EQ(add(context(), middle), PT_OK) << pt_last_error(context());
    accumulate_on(context(), 13);
    EXPECT_EQ(picture_of(context()).stats.sample_count, 80U);
    accumulate_on(context(), 20);
    EXPECT_TRUE(picture_of(context()) == expected);
    EXPECT_FALSE(whole(99) == expected);
}

TEST_F(SavedFilm, RowsAreFilmsOfTheirOwn) {
    pt_render rows = settings(0);
    rows.first_row = 3;
    rows.row_count = 5;
    set_up(context(), rows);
    accumulate_on(context(), 40);
    const Picture expected = picture_of(context(), rows.row_count);
    rows.first_sample = 17;
    set_up(context(), rows);
    accumulate_on(context(), 23);
    const Bytes late = film_of(context());
    rows.first_sample = 0;
    set_up(context(), rows);
    ASSERT_EQ(add(context(), late), PT_OK) << pt_last_error(context());
    accumulate_on(context(), 17);
    EXPECT_TRUE(picture_of(context(), rows.row_count) == expected);

    set_up(context(), settings(0));
    EXPECT_EQ(add(context(), late), PT_ERROR_INCOMPATIBLE);
    EXPECT_EQ(
        pt_last_error(context()),
        std::string(
            "film: its tiles must be whole ones of this context, squares of 8 pixels from the top left of what is "
            "rendered on"));
}

TEST_F(SavedFilm, StrangersAreRefusedAndNothingChanges) {
    const auto strange_film = [&](const std::function<void(pt_render &, pt_camera &)> &change) {
        pt_render render = settings(0);
        pt_camera camera = CourseworkScene::camera();
        change(render, camera);
        set_up(context(), render, camera);
        accumulate_on(context(), 12);
        return film_of(context());
    };
    const auto edited = [](Bytes film, const std::string &from, const std::string &to) {
        const auto place = std::search(film.begin(), film.end(), from.begin(), from.end());
        EXPECT_NE(place, film.end());
        std::copy(to.begin(), to.end(), place);
        return film;
    };
    const auto with_another = [](Bytes film, const std::string &name) {
        const std::string start = "\n" + name + ' ';
        const auto value = std::search(film.begin(), film.end(), start.begin(), start.end()) +
                           static_cast<std::ptrdiff_t>(start.size());
        *value = *value == '7' ? '8' : '7';
        seal(film);
        return film;
    };
    const Bytes good = part(12, 20);
    Bytes truncated = good;
    truncated.pop_back();
    const struct {
        Bytes film;
        std::string message;
    } cases[] = {
        {strange_film([](pt_render &render, pt_camera &) { render.seed = 77; }),
         "film.seed = 77: must be 0, as in this context"},
        {strange_film([](pt_render &render, pt_camera &) {
             render.sampler = PT_SAMPLER_RANDOM;
             render.max_path_length = 4;
         }),
         "film.max_path_length = 4: must be 3, as in this context\nfilm.sampler = 1: must be 4, as in this context"},
        {strange_film([](pt_render &, pt_camera &camera) { camera.vertical_fov = 0.5; }), "film.camera = "},
        {part(19, 22), "film.samples = [19, 22): [19, 20) are already in the film"},
        {good, "film.samples = [12, 20): [12, 20) are already in the film"},
        {with_another(good, "kernel"), "film.kernel = "},
        {with_another(good, "device"), "film.device = "},
        {with_another(good, "estimator_version"), "film.estimator_version = "},
        {truncated, "film: it has "},
        {edited(good, "\nkernel", "\ncernel"), "film: its checksum does not match its bytes, which are damaged"},
        {Bytes{}, "film: these bytes are not a film"},
    };
    set_up(context(), settings(0));
    accumulate_on(context(), 12);
    ASSERT_EQ(add(context(), good), PT_OK) << pt_last_error(context());
    const Picture before = picture_of(context());
    for (const auto &[film, message] : cases) {
        EXPECT_EQ(pt_add_film(context(), film.empty() ? "" : film.data(), film.size()), PT_ERROR_INCOMPATIBLE);
        EXPECT_EQ(std::string(pt_last_error(context())).substr(0, message.size()), message);
        ASSERT_TRUE(picture_of(context()) == before) << message;
    }
}

TEST_F(SavedFilm, CallsAreRefusedAsTheHeaderSays) {
    uint64_t size = 5;
    char byte = 'x';
    EXPECT_EQ(pt_save_film(context(), nullptr, &size), PT_ERROR_INVALID_STATE);
    EXPECT_EQ(pt_last_error(context()), std::string("no scene: call pt_set_scene first"));
    EXPECT_EQ(pt_add_film(context(), &byte, 1), PT_ERROR_INVALID_STATE);
    set_up(context(), settings(0));
    EXPECT_EQ(pt_save_film(context(), nullptr, &size), PT_ERROR_INVALID_STATE);
    EXPECT_EQ(pt_last_error(context()), std::string("no samples yet: call pt_accumulate or pt_add_film first"));
    EXPECT_EQ(pt_add_film(context(), nullptr, 1), PT_ERROR_INVALID_ARGUMENT);
    EXPECT_EQ(pt_save_film(context(), nullptr, nullptr), PT_ERROR_INVALID_ARGUMENT);
    accumulate_on(context(), 1);
    EXPECT_EQ(pt_save_film(context(), &byte, &size), PT_ERROR_INVALID_ARGUMENT);
    EXPECT_EQ(size, 5U);
    EXPECT_EQ(byte, 'x');
    uint64_t needed = 0;
    EXPECT_EQ(pt_save_film(context(), nullptr, &needed), PT_OK);
    EXPECT_EQ(pt_save_film(context(), &byte, &size), PT_ERROR_INVALID_ARGUMENT);
    EXPECT_EQ(pt_last_error(context()), "film.size_bytes = 5: must be >= " + std::to_string(needed));
}

} // namespace
