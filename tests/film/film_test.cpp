#include "lib/film/film.h"

#include "tests/support/expected_error.h"
#include "tests/support/film_maker.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstring>
#include <random>
#include <string>

namespace {

using film_maker::Bytes;
using film_maker::Samples;

constexpr std::uint32_t image_width = 21;
constexpr std::uint32_t image_height = 13;

Bytes bytes_of(const pt::Film &film) {
    Bytes bytes(pt::FilmLayout(film.header()).size_bytes());
    film.write(bytes);
    return bytes;
}

std::vector<pt::Rectangle> grid(std::uint32_t width, std::uint32_t height) {
    std::vector<pt::Rectangle> tiles;
    for (std::uint32_t y = 0; y < image_height; y += height)
        for (std::uint32_t x = 0; x < image_width; x += width)
            tiles.push_back({x, y, std::min(width, image_width - x), std::min(height, image_height - y)});
    return tiles;
}

void give(Samples &samples, const pt::Rectangle &tile, const std::set<std::uint32_t> &indices) {
    for (std::uint32_t y = tile.y; y < tile.y + tile.height; ++y)
        for (std::uint32_t x = tile.x; x < tile.x + tile.width; ++x)
            samples[{y, x}].insert(indices.begin(), indices.end());
}

Bytes film_by_sample(const Samples &samples, bool has_coverage = false) {
    return film_maker::film_of(film_maker::identity(image_width, image_height, has_coverage),
                               film_maker::tiles_of(samples), samples);
}

struct Part {
    Samples samples;
    Bytes bytes;
};

Part random_part(std::mt19937 &random, std::uint32_t first, bool has_coverage) {
    const std::pair<std::uint32_t, std::uint32_t> grids[] = {
        {image_width, image_height}, {8, 8}, {image_width, 4}, {5, 3}};
    const auto [width, height] = grids[random() % std::size(grids)];
    std::vector<pt::Rectangle> tiles = grid(width, height);
    if (tiles.size() > 1 && random() % 3 == 0)
        tiles.erase(tiles.begin() + static_cast<std::ptrdiff_t>(random() % tiles.size()));
    const bool is_uniform = random() % 2 == 0;
    Part part;
    std::set<std::uint32_t> indices;
    for (const pt::Rectangle &tile : tiles) {
        if (indices.empty() || !is_uniform) {
            indices.clear();
            for (std::uint32_t i = 0; i < 10; ++i)
                if (random() % 2 == 0 || i == 0)
                    indices.insert(first + i);
        }
        give(part.samples, tile, indices);
    }
    part.bytes =
        film_maker::film_of(film_maker::identity(image_width, image_height, has_coverage), tiles, part.samples);
    return part;
}

TEST(Film, SumsHaveTheBytesOfTheirSamplesInAnyOrder) {
    std::mt19937 random(1);
    for (int round = 0; round < 40; ++round) {
        std::vector<Part> parts;
        Samples all;
        const bool has_coverage = round % 2 == 1;
        for (std::uint32_t i = 0; i < 2 + random() % 4; ++i) {
            parts.push_back(random_part(random, 10 * i, has_coverage));
            for (const auto &[pixel, indices] : parts.back().samples)
                all[pixel].insert(indices.begin(), indices.end());
        }
        const Bytes expected = film_by_sample(all, has_coverage);
        for (int order = 0; order < 3; ++order) {
            std::ranges::shuffle(parts, random);
            pt::Film sum(parts.front().bytes);
            for (std::size_t i = 1; i < parts.size(); ++i)
                sum.add(pt::Film(parts[i].bytes));
            ASSERT_TRUE(bytes_of(sum) == expected) << "round " << round << ", order " << order;
            EXPECT_EQ(sum.bounds(), pt::Film(expected).bounds());
        }
    }
}

// The tile beside ends halfway down.
TEST(Film, CutsNoTileWhereAnotherEnds) {
    const pt::FilmIdentity identity = film_maker::identity(image_width, image_height);
    const pt::Rectangle high{0, 0, 8, image_height};
    const pt::Rectangle beside{8, 0, 8, 8};
    Samples present;
    give(present, high, {0});
    give(present, beside, {0});
    Samples added;
    give(added, high, {1});
    pt::Film film(film_maker::film_of(identity, {high, beside}, present));
    film.add(pt::Film(film_maker::film_of(identity, {high}, added)));
    give(present, high, {1});
    EXPECT_TRUE(bytes_of(film) == film_by_sample(present));
}

TEST(Film, KnowsTheSamplesForLampsOfAllThatWereAdded) {
    const auto film_with = [](std::uint32_t sample, const std::vector<pt::LampSquare> &lamps) {
        Samples samples;
        give(samples, {0, 0, image_width, image_height}, {sample});
        return pt::Film(film_maker::film_of(film_maker::identity(image_width, image_height),
                                            film_maker::tiles_of(samples), samples, lamps));
    };
    pt::Film sum = film_with(0, {{8, 0, 30}, {0, 8, 20}});
    sum.add(film_with(1, {{0, 0, 5}, {8, 0, 40}}));
    EXPECT_EQ(sum.header().lamps, (std::vector<pt::LampSquare>{{0, 0, 5}, {8, 0, 40}, {0, 8, 20}}));
    EXPECT_EQ(sum.samples_for_lamps(), 40U);
}

// One tile has another sample, or a pixel has none.
TEST(Film, HasNoSamplesBySquaresThatATileCuts) {
    Samples samples;
    give(samples, {0, 0, image_width, image_height}, {0});
    EXPECT_EQ(pt::Film(film_by_sample(samples)).samples_by_tile().grid().count(), grid(8, 8).size());
    Samples cut = samples;
    give(cut, {9, 3, 2, 1}, {7});
    Samples gap = samples;
    gap.erase({2, 2});
    for (const Samples &each : {cut, gap}) {
        const pt::Film film(film_by_sample(each));
        EXPECT_EQ(error_of([&] { (void)film.samples_by_tile(); }).code(), PT_ERROR_INCOMPATIBLE);
    }
}

TEST(Film, WhatDoesNotBelongChangesNothing) {
    Samples samples;
    give(samples, {0, 0, image_width, image_height}, {0, 1, 2});
    pt::Film film(film_by_sample(samples));
    const Bytes before = bytes_of(film);
    const auto refusal = [&](const pt::FilmIdentity &identity, const Samples &other) {
        const pt::Error error =
            error_of([&] { film.add(pt::Film(film_maker::film_of(identity, film_maker::tiles_of(other), other))); });
        EXPECT_EQ(error.code(), PT_ERROR_INCOMPATIBLE);
        EXPECT_TRUE(bytes_of(film) == before) << error.what();
        return std::string(error.what());
    };
    const pt::FilmIdentity same = film_maker::identity(image_width, image_height);
    pt::FilmIdentity seed = same;
    seed[5].value = "7";
    Samples others;
    give(others, {0, 0, image_width, image_height}, {3, 4});
    EXPECT_EQ(refusal(film_maker::identity(image_width, image_height, true), others),
              "film.coverage = 1: must be absent");
    EXPECT_EQ(refusal(seed, others), "film.seed = 7: must be 18446744073709551615, as in the film that it is added to");
    give(others, {8, 8, 4, 4}, {1});
    EXPECT_EQ(refusal(same, others),
              "film.samples = [1, 2), [3, 5) in the 4x4 pixels from (8, 8): [1, 2) are already in the film");
}

TEST(Film, WhatNoPictureHasIsRefused) {
    const pt::FilmIdentity good = film_maker::identity(image_width, image_height);
    Samples samples;
    give(samples, {0, 0, image_width, image_height}, {0});
    const auto refusal = [&](const pt::FilmIdentity &identity, const std::vector<pt::Rectangle> &tiles) {
        const pt::Error error = error_of([&] { const pt::Film film(film_maker::film_of(identity, tiles, samples)); });
        EXPECT_EQ(error.code(), PT_ERROR_INCOMPATIBLE);
        return std::string(error.what());
    };
    EXPECT_EQ(refusal(good, {{0, 0, 4, 4}, {3, 2, 4, 4}}), "film: its tiles overlap in row 2, column 3");
    EXPECT_EQ(refusal(good, {}), "film: it has no tile");
    pt::FilmIdentity small = good;
    small[3].value = "12";
    EXPECT_EQ(refusal(small, grid(image_width, image_height)), "film: its tiles reach beyond the image");
    pt::FilmIdentity strange = good;
    strange[2].value = "021";
    strange[6].value = "9";
    strange[8].value = "-301";
    EXPECT_EQ(refusal(strange, grid(image_width, image_height)), "film.width = 021: must be from 1 to 4294967295\n"
                                                                 "film.estimator = 9: must be from 1 to 5\n"
                                                                 "film.unit_exponent = -301: must be from -300 to 300");
    pt::FilmIdentity without = good;
    without.erase(without.begin() + 5);
    EXPECT_EQ(refusal(without, grid(image_width, image_height)),
              "film.seed = nothing: must be from 0 to 18446744073709551615");
    for (const bool has_coverage : {false, true}) {
        Bytes unharmed =
            film_maker::film_of(film_maker::identity(image_width, image_height, has_coverage), grid(8, 8), samples);
        const pt::Film film(unharmed);
        unharmed[unharmed.size() - 100] ^= std::byte{2}; // changes a count; the checksum stays valid
        const std::size_t checked = unharmed.size() - sizeof(std::uint64_t);
        const std::uint64_t checksum = pt::checksum(std::span(unharmed).first(checked));
        std::memcpy(&unharmed[checked], &checksum, sizeof checksum);
        EXPECT_EQ(error_of([&] { const pt::Film damaged(unharmed); }).what(),
                  std::string("film: its sums cannot come from its samples"));
    }
}

} // namespace
