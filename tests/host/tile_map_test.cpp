// Tile lists: found by pixel, cut along each other, and brought to one form, against a search pixel by pixel.
#include "lib/film/tile_map.h"

#include "tests/support/film_maker.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <optional>
#include <random>
#include <string>
#include <utility>
#include <vector>

namespace {

// Rectangles that do not overlap, within 24 x 24 pixels, with one of a few sets of samples.
std::vector<pt::FilmTile> random_tiles(std::mt19937 &random) {
    std::vector<pt::FilmTile> tiles;
    bool taken[24][24] = {};
    for (int i = 0; i < 40; ++i) {
        const auto x = static_cast<std::uint32_t>(random() % 20);
        const auto y = static_cast<std::uint32_t>(random() % 20);
        const pt::Rectangle pixels{x, y, 1 + static_cast<std::uint32_t>(random() % 4),
                                   1 + static_cast<std::uint32_t>(random() % 4)};
        bool is_free = true;
        for (std::uint32_t row = y; row < y + pixels.height; ++row)
            for (std::uint32_t column = x; column < x + pixels.width; ++column)
                is_free = is_free && !taken[row][column];
        if (!is_free)
            continue;
        for (std::uint32_t row = y; row < y + pixels.height; ++row)
            for (std::uint32_t column = x; column < x + pixels.width; ++column)
                taken[row][column] = true;
        tiles.push_back({pixels, pt::SampleSet({random() % 2, 2})});
    }
    return tiles;
}

bool holds(const pt::Rectangle &tile, std::uint32_t x, std::uint32_t y) {
    return x >= tile.x && x < tile.x + tile.width && y >= tile.y && y < tile.y + tile.height;
}

TEST(TileMap, FindsPixels) {
    std::mt19937 random(1);
    for (int round = 0; round < 50; ++round) {
        const std::vector<pt::FilmTile> tiles = random_tiles(random);
        const pt::TileMap map(tiles);
        for (std::uint32_t y = 0; y < 24; ++y)
            for (std::uint32_t x = 0; x < 24; ++x) {
                const auto tile =
                    std::ranges::find_if(tiles, [&](const pt::FilmTile &each) { return holds(each.pixels, x, y); });
                const pt::TileMap::Span *span = map.find(x, y);
                ASSERT_EQ(span != nullptr, tile != tiles.end());
                if (span) {
                    ASSERT_EQ(span->tile, static_cast<std::size_t>(tile - tiles.begin()));
                }
            }
    }
}

// Pieces have each pixel once, and all of one piece are in the tile that it says.
TEST(TileMap, CutsRectangles) {
    std::mt19937 random(3);
    for (int round = 0; round < 200; ++round) {
        const pt::TileMap map(random_tiles(random));
        const pt::Rectangle pixels{static_cast<std::uint32_t>(random() % 20), static_cast<std::uint32_t>(random() % 20),
                                   1 + static_cast<std::uint32_t>(random() % 10),
                                   1 + static_cast<std::uint32_t>(random() % 10)};
        std::vector<std::pair<std::uint32_t, std::uint32_t>> seen;
        for (const pt::TileMap::Piece &piece : map.cut(pixels))
            for (std::uint32_t y = piece.pixels.y; y < piece.pixels.y + piece.pixels.height; ++y)
                for (std::uint32_t x = piece.pixels.x; x < piece.pixels.x + piece.pixels.width; ++x) {
                    ASSERT_TRUE(holds(pixels, x, y));
                    seen.emplace_back(x, y);
                    const pt::TileMap::Span *span = map.find(x, y);
                    ASSERT_EQ(piece.tile, span ? std::optional(span->tile) : std::nullopt);
                }
        std::ranges::sort(seen);
        EXPECT_EQ(std::ranges::adjacent_find(seen), seen.end());
        EXPECT_EQ(seen.size(), pixels.pixel_count());
    }
}

TEST(TileMap, CutsNothingThatLiesInOneTileOrBesideAll) {
    const pt::SampleSet samples({0, 2});
    const pt::TileMap map({{{8, 0, 8, 8}, samples}, {{8, 8, 4, 4}, samples}, {{12, 8, 4, 8}, samples}});
    EXPECT_EQ(map.cut({8, 1, 8, 7}).size(), 1U);
    EXPECT_EQ(map.cut({0, 0, 8, 24}).size(), 1U);
    EXPECT_EQ(map.cut({12, 9, 4, 7}).size(), 1U);
    EXPECT_EQ(map.cut({8, 0, 8, 9}).size(), 3U);
}

TEST(TileMap, CanonicalTilesAreThoseOfThePixels) {
    std::mt19937 random(2);
    for (int round = 0; round < 50; ++round) {
        std::vector<pt::FilmTile> tiles = random_tiles(random);
        film_maker::Samples samples;
        for (const pt::FilmTile &tile : tiles)
            for (std::uint32_t y = tile.pixels.y; y < tile.pixels.y + tile.pixels.height; ++y)
                for (std::uint32_t x = tile.pixels.x; x < tile.pixels.x + tile.pixels.width; ++x)
                    samples[{y, x}] =
                        tile.samples.count() == 2 ? std::set<std::uint32_t>{0, 1} : std::set<std::uint32_t>{1};
        const std::vector<pt::Rectangle> expected = film_maker::tiles_of(samples);
        const std::vector<pt::FilmTile> canonical = pt::canonical_tiles(tiles);
        ASSERT_TRUE(std::ranges::equal(canonical, expected, {}, &pt::FilmTile::pixels)) << "round " << round;
        std::ranges::shuffle(tiles, random);
        EXPECT_TRUE(pt::canonical_tiles(tiles) == canonical);
    }
}

TEST(TileMap, RowsThatDoNotTouchStayApart) {
    const pt::SampleSet samples({0, 2});
    const std::vector<pt::FilmTile> tiles = {{{0, 0, 4, 2}, samples}, {{0, 3, 4, 2}, samples}};
    EXPECT_TRUE(pt::canonical_tiles(tiles) == tiles);
}

} // namespace
