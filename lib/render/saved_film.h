#pragma once

#include "lib/film/film_bytes.h"
#include "lib/film/tile_samples.h"
#include "lib/kernel/device_film.h"

#include <cstddef>
#include <span>

namespace pt {

// Writes the sum of films of one size into memory of FilmLayout's size. `samples` are the samples of all films
// together, `pixels` is the films' rectangle in the image. The header may have fewer pixels.
void save(std::span<DeviceFilm *const> films, const TileSamples &samples, const FilmHeader &header,
          const Rectangle &pixels, std::span<std::byte> bytes);

// Returns the film's samples by tiles of a context with these pixels. Throws PT_ERROR_INCOMPATIBLE if the film has
// other pixels, or different samples within a tile.
TileSamples samples_of_film(const FilmHeader &film, const Rectangle &pixels);

// Throws PT_ERROR_INCOMPATIBLE if both have the same sample of a tile.
TileSamples united(const TileSamples &present, const TileSamples &added);

// Adds a saved film and the other films to films[0]. `all` must be united(present, added). If the saved samples cannot
// have the saved sums, throws PT_ERROR_INCOMPATIBLE and changes nothing.
void add(const FilmReader &film, const TileSamples &added, std::span<DeviceFilm *const> films,
         const TileSamples &present, const TileSamples &all, const Rectangle &pixels, vulkan::Device &device);

} // namespace pt
