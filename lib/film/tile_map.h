// Which tile of a film each pixel lies in, by rows: how tile lists are checked, cut along each other and
// brought to the one form in which films are written; and how they become the tiles of a grid and come from them.
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
    // Columns [first, end) of a band, in a tile.
    struct Span {
        std::uint32_t first;
        std::uint32_t end;
        std::size_t tile;
    };

    // Rows [first, end) that meet the same tiles: spans from left to right.
    struct Band {
        std::uint32_t first;
        std::uint32_t end;
        std::vector<Span> spans;
    };

    // Pixels that lie in one tile, or in none.
    struct Piece {
        Rectangle pixels;
        std::optional<std::size_t> tile;
    };

    // Throws PT_ERROR_INCOMPATIBLE if tiles overlap. A tile is in no more bands than it has rows, so a map takes no
    // more memory than its film's sums.
    explicit TileMap(const std::vector<FilmTile> &tiles);

    // From the top to the bottom, without rows that have no pixels.
    const std::vector<Band> &bands() const { return bands_; }

    // The span with a pixel; NULL if no tile has it.
    const Span *find(std::uint32_t x, std::uint32_t y) const;

    // The pieces into which the tiles cut a rectangle: one where they do not.
    std::vector<Piece> cut(const Rectangle &pixels) const;

private:
    std::vector<Band> bands_;
};

// The smallest rectangle with all tiles; there is at least one.
Rectangle bounds_of(const std::vector<FilmTile> &tiles);

// The same pixels and samples as a list that does not depend on how they were listed. Neighbours in a row with equal
// samples are together, and so are equal runs of them in rows one below the other. Tiles come from the top down, and
// from left to right among those that begin in one row.
std::vector<FilmTile> canonical_tiles(const std::vector<FilmTile> &tiles);

// The tiles of a film with these pixels of an image, as few as possible.
std::vector<FilmTile> film_tiles(const TileSamples &samples, const Rectangle &pixels);

// The samples by tile of a grid over these pixels of an image; nothing if the tiles of the film cut those of the grid.
std::optional<TileSamples> tile_samples(const std::vector<FilmTile> &tiles, const Rectangle &pixels);

} // namespace pt
