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
    struct Span {
        std::uint32_t first;
        std::uint32_t end;
        std::size_t tile;
    };

    struct Band {
        std::uint32_t first;
        std::uint32_t end;
        std::vector<Span> spans;
    };

    struct Piece {
        Rectangle pixels;
        std::optional<std::size_t> tile;
    };

    // Throws PT_ERROR_INCOMPATIBLE if tiles overlap.
    explicit TileMap(const std::vector<FilmTile> &tiles);

    const std::vector<Band> &bands() const { return bands_; }

    const Span *find(std::uint32_t x, std::uint32_t y) const;

    std::vector<Piece> cut(const Rectangle &pixels) const;

private:
    std::vector<Band> bands_;
};

Rectangle bounds_of(const std::vector<FilmTile> &tiles);

// Joins neighbors in a row that have equal samples, then equal runs in adjacent rows. Sorts tiles from top to bottom,
// then from left to right.
std::vector<FilmTile> canonical_tiles(const std::vector<FilmTile> &tiles);

std::vector<FilmTile> film_tiles(const TileSamples &samples, const Rectangle &pixels);

// Returns no value if a tile of the TileGrid has pixels with different samples.
std::optional<TileSamples> tile_samples(const std::vector<FilmTile> &tiles, const Rectangle &pixels);

} // namespace pt
