// How the tiles of a film's bytes and those of a film in memory follow from each other.
#pragma once

#include "lib/film/film_header.h"
#include "lib/film/tile_samples.h"

#include <optional>
#include <vector>

namespace pt {

// The tiles of a film of these pixels of an image, as few as may be.
std::vector<FilmTile> film_tiles(const TileSamples &samples, const Rectangle &pixels);

// The samples, by tile of a grid over these pixels of an image, of the film's tiles in them; nothing if these cut tiles
// of the grid.
std::optional<TileSamples> tile_samples(const std::vector<FilmTile> &tiles, const Rectangle &pixels);

} // namespace pt
