// Maps pixels to a film's tiles. Checks tile lists, cuts them along each other, brings them to the canonical form of
// written films, and converts them to and from the tiles of a grid.
#pragma once

#include "lib/film/film_header.h"
#include "lib/film/tile_samples.h"

#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

namespace pt {

class TileMap {
public:
    // Columns [first, end) of a band, within a tile.
    struct Span {
        std::uint32_t first;
        std::uint32_t end;
        std::size_t tile;
    };

    // Rows [first, end) that meet the same tiles; spans from left to right.
    struct Band {
        std::uint32_t first;
        std::uint32_t end;
        std::vector<Span> spans;
    };

    // Pixels within one tile, or in none.
    struct Piece {
        Rectangle pixels;
        std::optional<std::size_t> tile;
    };

    // Throws PT_ERROR_INCOMPATIBLE if tiles overlap. A tile is in no more bands than it has rows, so a map takes no
    // more memory than its film's sums.
    explicit TileMap(const std::vector<FilmTile> &tiles);

    // Ordered from the top down; rows without pixels are in none.
    const std::vector<Band> &bands() const { return bands_; }

    // NULL if no tile has the pixel.
    const Span *find(std::uint32_t x, std::uint32_t y) const;

    std::vector<Piece> cut(const Rectangle &pixels) const;

private:
    std::vector<Band> bands_;
};

// Contains all tiles; at least one.
Rectangle bounds_of(const std::vector<FilmTile> &tiles);

// The same pixels and samples: neighbors in a row with equal samples are joined, then equal runs in adjacent rows.
// Sorted from the top down, then from left to right.
std::vector<FilmTile> canonical_tiles(const std::vector<FilmTile> &tiles);

// As few tiles as possible. pixels: the film's, in the image.
std::vector<FilmTile> film_tiles(const TileSamples &samples, const Rectangle &pixels);

// Samples by tile of a grid over these pixels; nothing if the film's tiles cut the grid's.
std::optional<TileSamples> tile_samples(const std::vector<FilmTile> &tiles, const Rectangle &pixels);

} // namespace pt
