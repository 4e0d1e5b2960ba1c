// Converts between the tiles in a film's bytes and the tiles of a film in memory.
#pragma once

#include "lib/film/film_header.h"
#include "lib/film/tile_samples.h"

#include <optional>
#include <vector>

namespace pt {

// The tiles of a film with these pixels of an image, as few as possible.
std::vector<FilmTile> film_tiles(const TileSamples &samples, const Rectangle &pixels);

// The samples by tile of a grid over these pixels of an image; nothing if the tiles of the film cut those of the grid.
std::optional<TileSamples> tile_samples(const std::vector<FilmTile> &tiles, const Rectangle &pixels);

} // namespace pt
