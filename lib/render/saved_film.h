// Moves films between devices and bytes.
#pragma once

#include "lib/film/film_bytes.h"
#include "lib/film/tile_samples.h"
#include "lib/kernel/device_film.h"

#include <cstddef>
#include <span>
#include <vector>

namespace pt {

// Writes the sum of films of one size, which together hold `samples`, into memory of FilmLayout's size. The header has
// the same samples, perhaps of fewer pixels. pixels: the films', in the image.
void save(std::span<DeviceFilm *const> films, const TileSamples &samples, const FilmHeader &header,
          const Rectangle &pixels, std::span<std::byte> bytes);

// By tile of a context with these pixels. Throws PT_ERROR_INCOMPATIBLE if the film has other pixels or cuts tiles.
TileSamples samples_of_film(const FilmHeader &film, const Rectangle &pixels);

// Throws PT_ERROR_INCOMPATIBLE if a tile has the same sample in both.
TileSamples united(const TileSamples &present, const TileSamples &added);

// Adds a saved film and all films to the first of them. If its sums are impossible for its samples, throws
// PT_ERROR_INCOMPATIBLE and changes nothing. all: united(present, added).
void add(const FilmReader &film, const TileSamples &added, std::span<DeviceFilm *const> films,
         const TileSamples &present, const TileSamples &all, const Rectangle &pixels, vulkan::Device &device);

} // namespace pt
