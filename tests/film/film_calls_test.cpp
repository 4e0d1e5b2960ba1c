#include "tests/support/film_maker.h"
#include "tests/support/image_target.h"
#include "tests/support/sized.h"

#include <pt/errors.h>
#include <pt/film.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <memory>
#include <span>
#include <string>
#include <utility>
#include <vector>

namespace {

struct CloseFilm {
    void operator()(pt_film *film) const { pt_close_film(film); }
};
using OpenedFilm = std::unique_ptr<pt_film, CloseFilm>;

film_maker::Samples two_tiles() {
    film_maker::Samples samples;
    for (std::uint32_t y = 2; y < 5; ++y)
        for (std::uint32_t x = 1; x < 6; ++x)
            for (std::uint32_t i = 0; i < (x < 4 ? 3U : 20U); ++i)
                samples[{y, x}].insert(i);
    return samples;
}

film_maker::Bytes bytes_of(const film_maker::Samples &samples) {
    return film_maker::film_of(film_maker::identity(9, 7), film_maker::tiles_of(samples), samples);
}

OpenedFilm opened(const film_maker::Bytes &bytes) {
    pt_film *film = nullptr;
    EXPECT_EQ(pt_open_film(bytes.data(), bytes.size(), &film), PT_OK) << pt_last_error(nullptr);
    return OpenedFilm(film);
}

pt_image image_in(std::vector<float> &pixels, std::uint32_t quantity) {
    auto image = sized<pt_image>();
    image.quantity = quantity;
    image.data = pixels.data();
    image.size_bytes = pixels.size() * sizeof(float);
    return image;
}

void expect_refusal(pt_result result, pt_result expected, const std::string &message) {
    EXPECT_EQ(result, expected);
    EXPECT_EQ(pt_last_error(nullptr), message);
}

TEST(FilmCalls, TellWhatAFilmIsOf) {
    const OpenedFilm film = opened(bytes_of(two_tiles()));
    auto info = sized<pt_film_info>();
    ASSERT_EQ(pt_get_film_info(film.get(), &info), PT_OK);
    EXPECT_EQ(info.max_path_length, 6U);
    EXPECT_EQ(info.tile_count, 2U);
    EXPECT_STREQ(info.device, "a device, its driver 1.2");
    info.struct_size = offsetof(pt_film_info, width);
    info.width = 77;
    EXPECT_EQ(pt_get_film_info(film.get(), &info), PT_OK);
    EXPECT_EQ(info.width, 77U) << "wrote beyond the caller's struct";
}

TEST(FilmCalls, TellWhichSamplesThereAre) {
    film_maker::Samples samples = two_tiles();
    for (auto &[pixel, indices] : samples)
        if (pixel.second >= 4)
            indices.erase(7);
    const OpenedFilm film = opened(bytes_of(samples));
    auto tile = sized<pt_film_tile>();
    ASSERT_EQ(pt_get_film_tile(film.get(), 1, &tile), PT_OK);
    EXPECT_EQ((std::array{tile.x, tile.y, tile.width, tile.height, tile.range_count}),
              (std::array{4U, 2U, 2U, 3U, 2U}));
    using Ends = std::array<std::uint64_t, 6>;
    for (const auto &[room, expected] :
         {std::pair{0U, Ends{9, 9, 9, 9, 9, 9}}, {1U, {0, 7, 9, 9, 9, 9}}, {3U, {0, 7, 8, 20, 9, 9}}}) {
        pt_sample_range ranges[3] = {{9, 9}, {9, 9}, {9, 9}};
        std::uint32_t count = room;
        EXPECT_EQ(pt_get_film_ranges(film.get(), 1, room > 0 ? ranges : nullptr, &count), PT_OK);
        EXPECT_EQ(count, room == 1 ? 1U : 2U);
        const auto &[a, b, c] = ranges;
        EXPECT_EQ((Ends{a.first, a.end, b.first, b.end, c.first, c.end}), expected);
    }
    std::uint32_t count = 0;
    expect_refusal(pt_get_film_tile(film.get(), 2, &tile), PT_ERROR_INVALID_ARGUMENT, "tile = 2: must be below 2");
    expect_refusal(pt_get_film_ranges(film.get(), 7, nullptr, &count), PT_ERROR_INVALID_ARGUMENT,
                   "tile = 7: must be below 2");
}

struct Stream {
    std::size_t most;
    film_maker::Bytes bytes;
};

std::int32_t append(void *user, const void *data, std::uint64_t size) {
    auto &stream = *static_cast<Stream *>(user);
    const auto *first = static_cast<const std::byte *>(data);
    EXPECT_LE(size, 1U << 20);
    stream.bytes.insert(stream.bytes.end(), first, first + size);
    return stream.bytes.size() > stream.most ? 1 : 0;
}

TEST(FilmCalls, HandOnTheBytes) {
    constexpr pt::Rectangle large{0, 0, 33'000, 2};
    film_maker::Samples samples;
    for (std::uint32_t y = 0; y < large.height; ++y)
        for (std::uint32_t x = 0; x < large.width; ++x)
            samples[{y, x}] = {0, 9};
    const auto bytes = film_maker::film_of(film_maker::identity(large.width, large.height), {large}, samples);
    for (const std::size_t most : {bytes.size() / 2, bytes.size()}) {
        Stream stream{most, {}};
        const bool is_ended = most < bytes.size();
        EXPECT_EQ(pt_stream_film(opened(bytes).get(), append, &stream), is_ended ? PT_CANCELLED : PT_OK);
        EXPECT_EQ(stream.bytes.size() < bytes.size(), is_ended);
        EXPECT_TRUE(std::ranges::equal(stream.bytes, std::span(bytes).first(stream.bytes.size())));
    }
}

TEST(FilmCalls, ReadImages) {
    film_maker::Samples samples = two_tiles();
    samples.erase({2, 1});
    const OpenedFilm film = opened(bytes_of(samples));
    for (const std::uint32_t quantity : {PT_QUANTITY_RADIANCE, PT_QUANTITY_STANDARD_ERROR}) {
        std::vector<float> all(3 * 5 * 3, -1.0F);
        pt_image image = image_in(all, quantity);
        ASSERT_EQ(pt_read_film(film.get(), &image), PT_OK) << pt_last_error(nullptr);
        EXPECT_EQ(all[0], quantity == PT_QUANTITY_RADIANCE ? 0.0F : std::numeric_limits<float>::infinity());
        for (std::size_t i = 3; i < all.size(); ++i)
            EXPECT_GE(all[i], 0.0F);
        EXPECT_GT(all[3 * 4], 0.0F);
        EXPECT_TRUE(std::isfinite(all[3 * 4])) << "of 20 samples";
        std::vector<float> part(3 * 2 * 2);
        image = image_in(part, quantity);
        set_part(image, {2, 1, 2, 2});
        ASSERT_EQ(pt_read_film(film.get(), &image), PT_OK) << pt_last_error(nullptr);
        for (std::size_t y = 0; y < 2; ++y)
            for (std::size_t i = 0; i < 6; ++i)
                EXPECT_EQ(part[6 * y + i], all[15 * (y + 1) + 6 + i]);
    }
    std::vector<float> few(44);
    const pt_image image = image_in(few, PT_QUANTITY_RADIANCE);
    EXPECT_EQ(pt_read_film(film.get(), &image), PT_ERROR_INVALID_ARGUMENT);
    EXPECT_EQ(pt_get_broken_rule(nullptr, 0, nullptr), 1U);
}

TEST(FilmCalls, WriteWhatTheyRead) {
    const film_maker::Bytes bytes = bytes_of(two_tiles());
    const OpenedFilm film = opened(bytes);
    film_maker::Bytes written(bytes.size() + 3, std::byte{7});
    std::uint64_t size = written.size();
    ASSERT_EQ(pt_write_film(film.get(), written.data(), &size), PT_OK);
    EXPECT_EQ(size, bytes.size());
    EXPECT_EQ(written[size], std::byte{7}) << "wrote beyond its size";
    written.resize(size);
    EXPECT_TRUE(written == bytes);
    --size;
    expect_refusal(pt_write_film(film.get(), written.data(), &size), PT_ERROR_INVALID_ARGUMENT,
                   "film.size_bytes = " + std::to_string(bytes.size() - 1) +
                       ": must be >= " + std::to_string(bytes.size()));
    EXPECT_EQ(size, bytes.size() - 1);
}

TEST(FilmCalls, RefuseWhatIsNotThere) {
    const film_maker::Bytes bytes = bytes_of(two_tiles());
    const OpenedFilm film = opened(bytes);
    auto *opening = reinterpret_cast<pt_film *>(1);
    expect_refusal(pt_open_film(nullptr, 5, &opening), PT_ERROR_INVALID_ARGUMENT, "data = NULL: must not be NULL");
    EXPECT_EQ(opening, nullptr);
    expect_refusal(pt_open_film(bytes.data(), bytes.size(), nullptr), PT_ERROR_INVALID_ARGUMENT,
                   "film = NULL: must not be NULL");
    opening = reinterpret_cast<pt_film *>(1);
    expect_refusal(pt_open_film("no film", 7, &opening), PT_ERROR_INCOMPATIBLE, "film: these bytes are not a film");
    EXPECT_EQ(opening, nullptr);
    film_maker::Samples others = two_tiles();
    for (std::uint32_t y = 2; y < 5; ++y)
        for (std::uint32_t x = 1; x < 4; ++x)
            others[{y, x}] = {3, 4};
    const film_maker::Bytes overlapping = bytes_of(others);
    expect_refusal(pt_merge_film(film.get(), overlapping.data(), overlapping.size()), PT_ERROR_INCOMPATIBLE,
                   "film.samples = [0, 20) in the 2x3 pixels from (4, 2): [0, 20) are already in the film");
    std::uint64_t size = bytes.size();
    film_maker::Bytes unchanged(size);
    EXPECT_EQ(pt_write_film(film.get(), unchanged.data(), &size), PT_OK);
    EXPECT_TRUE(unchanged == bytes);
    const std::string null_film = "film = NULL: must not be NULL";
    std::uint32_t count = 0;
    auto info = sized<pt_film_info>();
    auto tile = sized<pt_film_tile>();
    auto stats = sized<pt_stats>();
    auto error = sized<pt_error_estimate>();
    auto image = sized<pt_image>();
    const pt_result results[] = {pt_merge_film(nullptr, bytes.data(), bytes.size()),
                                 pt_write_film(nullptr, nullptr, &size),
                                 pt_read_film(nullptr, &image),
                                 pt_get_film_info(nullptr, &info),
                                 pt_get_film_tile(nullptr, 0, &tile),
                                 pt_get_film_ranges(nullptr, 0, nullptr, &count),
                                 pt_get_film_stats(nullptr, &stats),
                                 pt_get_film_error_estimate(nullptr, &error)};
    for (const pt_result result : results)
        expect_refusal(result, PT_ERROR_INVALID_ARGUMENT, null_film);
    expect_refusal(pt_stream_film(film.get(), nullptr, nullptr), PT_ERROR_INVALID_ARGUMENT,
                   "take = NULL: must not be NULL");
    expect_refusal(pt_get_film_info(film.get(), nullptr), PT_ERROR_INVALID_ARGUMENT, "info = NULL: must not be NULL");
    pt_close_film(nullptr);
}

} // namespace
