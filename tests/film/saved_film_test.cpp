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
    Bytes film;
    std::vector<float> radiance;
    double error;

    bool operator==(const Picture &) const = default;
};

class SavedFilm : public ContextFixture {
protected:
    static pt_render settings(uint32_t first_sample) {
        pt_render render = render_of(film_width, film_height + 6, 3);
        render.first_row = 3;
        render.row_count = film_height;
        render.first_sample = first_sample;
        return render;
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

    Picture picture() {
        return {film_of(context()), values_of(context(), std::size_t{film_width} * film_height),
                error().relative_rmse_high};
    }

    Bytes part(uint32_t first, uint32_t end) {
        set_coursework(context(), settings(first));
        accumulate(end - first);
        return film_of(context());
    }
};

// In every other round the context also takes samples, and refuses the parts that have some of them.
TEST_F(SavedFilm, PartsAddUpToTheWholeInAnyOrder) {
    constexpr uint32_t ends[] = {0, 3, 7, 30, 64, 65, 100, 128, 150};
    std::vector<Bytes> parts;
    for (std::size_t i = 1; i < std::size(ends); ++i)
        parts.push_back(part(ends[i - 1], ends[i]));
    part(0, 150);
    const Picture expected = picture();
    std::mt19937 random(1);
    const auto missing = [&] { return 150 - stats().sample_count; };
    int accepted = 0;
    for (int round = 0; round < 40; ++round) {
        std::ranges::shuffle(parts, random);
        set_coursework(context(), settings(0));
        const bool takes_samples = round % 2 == 1;
        for (const Bytes &film : parts) {
            if (takes_samples && missing() > 0)
                accumulate(std::min(missing(), static_cast<uint32_t>(1 + random() % 9)));
            const pt_result result = add(context(), film);
            ASSERT_TRUE(result == PT_OK || (takes_samples && result == PT_ERROR_INCOMPATIBLE)) << round;
            accepted += takes_samples && result == PT_OK;
        }
        if (missing() > 0)
            accumulate(missing());
        EXPECT_TRUE(picture() == expected) << "order " << round;
        EXPECT_TRUE(bytes_of(sum_of(parts).get()) == expected.film) << "order " << round;
    }
    EXPECT_GT(accepted, 0);
    part(0, 149);
    EXPECT_FALSE(picture() == expected) << "a missing sample must show";
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
    auto kept_error = sized<Error>();
    ASSERT_EQ(pt_get_film_error_estimate(value.get(), &kept_error), PT_OK) << pt_last_error(nullptr);
    const Error rendered = error();
    EXPECT_EQ(kept_error.uncertain, rendered.uncertain);
    for (double Error::*const each : {&Error::rmse, &Error::rmse_low, &Error::rmse_high, &Error::relative_rmse,
                                      &Error::relative_rmse_low, &Error::relative_rmse_high})
        // A GPU sums up to 3072 squares of 16 tiles in float32, with an error of 3072 x 2^-24.
        EXPECT_NEAR(kept_error.*each, rendered.*each, 2e-4 * rendered.*each);
}

TEST_F(SavedFilm, StrangersAreRefusedAndNothingChanges) {
    const auto strange_film = [&](const std::function<void(pt_render &, pt_camera &)> &change) {
        pt_render render = settings(0);
        pt_camera camera = CourseworkScene::camera();
        change(render, camera);
        set_coursework(context(), render, camera);
        accumulate(12);
        return film_of(context());
    };
    const auto with_another = [](Bytes film, const std::string &name) {
        const std::string start = "\n" + name + ' ';
        const auto value = std::search(film.begin(), film.end(), start.begin(), start.end()) +
                           static_cast<std::ptrdiff_t>(start.size());
        *value = *value == '7' ? '8' : '7';
        const std::size_t checked = film.size() - sizeof(uint64_t);
        const uint64_t checksum = pt::checksum(std::as_bytes(std::span(film).first(checked)));
        std::memcpy(&film[checked], &checksum, sizeof checksum);
        return film;
    };
    const Bytes good = part(12, 20);
    const struct {
        Bytes film;
        std::string message;
    } cases[] = {
        {strange_film([](pt_render &render, pt_camera &) {
             render.sampler = PT_SAMPLER_RANDOM;
             render.max_path_length = 4;
         }),
         "film.max_path_length = 4: must be 3, as in this context\nfilm.sampler = 1: must be 4, as in this context"},
        {strange_film([](pt_render &, pt_camera &camera) { camera.vertical_fov = 0.5; }), "film.camera = "},
        {strange_film([](pt_render &render, pt_camera &) {
             render.first_row = 6;
             render.row_count = 5;
         }),
         "film: its tiles must be whole ones of this context, squares of 8 pixels from the top left of what is "
         "rendered on"},
        {part(19, 22), "film.samples = [19, 22): [19, 20) are already in the film"},
        {good, "film.samples = [12, 20): [12, 20) are already in the film"},
        {with_another(good, "kernel"), "film.kernel = "},
        {with_another(good, "device"), "film.device = "},
        {with_another(good, "estimator_version"), "film.estimator_version = "},
        {Bytes(9, 'x'), "film: these bytes are not a film"},
    };
    set_coursework(context(), settings(0));
    accumulate(12);
    ASSERT_EQ(add(context(), good), PT_OK) << pt_last_error(context());
    const Picture before = picture();
    for (const auto &[film, message] : cases) {
        EXPECT_EQ(add(context(), film), PT_ERROR_INCOMPATIBLE);
        EXPECT_EQ(std::string(pt_last_error(context())).substr(0, message.size()), message);
        ASSERT_TRUE(picture() == before) << message;
    }
}

TEST_F(SavedFilm, CallsAreRefusedAsTheHeaderSays) {
    uint64_t size = 5;
    char byte = 'x';
    EXPECT_EQ(pt_save_film(context(), nullptr, &size), PT_ERROR_INVALID_STATE);
    EXPECT_STREQ(pt_last_error(context()), "no scene: call pt_set_scene first");
    EXPECT_EQ(pt_add_film(context(), &byte, 1), PT_ERROR_INVALID_STATE);
    set_coursework(context(), settings(0));
    EXPECT_EQ(pt_save_film(context(), nullptr, &size), PT_ERROR_INVALID_STATE);
    EXPECT_STREQ(pt_last_error(context()), "no samples yet: call pt_accumulate or pt_add_film first");
    EXPECT_EQ(pt_add_film(context(), nullptr, 1), PT_ERROR_INVALID_ARGUMENT);
    EXPECT_EQ(pt_save_film(context(), nullptr, nullptr), PT_ERROR_INVALID_ARGUMENT);
    accumulate(1);
    const Bytes film = film_of(context());
    EXPECT_EQ(pt_save_film(context(), &byte, &size), PT_ERROR_INVALID_ARGUMENT);
    EXPECT_EQ(pt_last_error(context()), "film.size_bytes = 5: must be >= " + std::to_string(film.size()));
    EXPECT_EQ(size, 5U);
    EXPECT_EQ(byte, 'x');
    Bytes larger(film.size() + 7, 'x');
    size = larger.size();
    EXPECT_EQ(pt_save_film(context(), larger.data(), &size), PT_OK) << pt_last_error(context());
    EXPECT_EQ(size, film.size());
    EXPECT_EQ(Bytes(larger.end() - 7, larger.end()), Bytes(7, 'x')) << "wrote beyond its size";
}

} // namespace
