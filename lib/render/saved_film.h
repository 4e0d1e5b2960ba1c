// Films on their way between devices and bytes. Used by Renderer.
#pragma once

#include "lib/film/film_bytes.h"
#include "lib/film/tile_samples.h"
#include "lib/kernel/device_film.h"

#include <cstddef>
#include <span>
#include <vector>

namespace pt {

// Writes the sum of films of one size, which together hold these samples and those of the header, to memory of the size
// that FilmLayout asks for. origin: the pixels of the image that the films have room for; the header may lack some.
void save(std::span<DeviceFilm *const> films, const TileSamples &samples, const FilmHeader &header,
          const Rectangle &origin, std::span<std::byte> bytes);

// The samples of a film by tile of a context with these pixels. Throws PT_ERROR_INCOMPATIBLE if it has others, or cuts
// tiles.
TileSamples samples_of_film(const FilmHeader &film, const Rectangle &pixels);

// Of both. Throws PT_ERROR_INCOMPATIBLE if a tile has one in both.
TileSamples united(const TileSamples &present, const TileSamples &added);

// Makes the first of the films the sum of all of them, which have these samples, and of a saved one, all of it or
// nothing: throws PT_ERROR_INCOMPATIBLE for sums that its samples cannot have. all: united(present, added).
void add(const FilmReader &film, const TileSamples &added, std::span<DeviceFilm *const> films,
         const TileSamples &present, const TileSamples &all, const Rectangle &pixels, vulkan::Device &device);

} // namespace pt
