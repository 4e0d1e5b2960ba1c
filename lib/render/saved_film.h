// Films on their way between devices and bytes. Used by Renderer.
#pragma once

#include "lib/film/device_film.h"
#include "lib/film/film_bytes.h"

#include <cstddef>
#include <span>

namespace pt {

// Writes the sum of films of one size, which together hold the samples of the header's one tile, to memory of the size
// that FilmLayout asks for.
void save(std::span<DeviceFilm *const> films, const FilmHeader &header, std::span<std::byte> bytes);

// Throws PT_ERROR_INCOMPATIBLE if the film has no tile with just these pixels, or samples that a context has already.
void require_addable(const FilmReader &film, const Rectangle &pixels, const SampleSet &present);

// Adds a film of one tile to one in a device's memory, all of it or nothing: throws PT_ERROR_INCOMPATIBLE for sums that
// its samples cannot have; hull: of the samples of both, and of all films that are rendered together.
void add(const FilmReader &film, const SampleRange &hull, vulkan::Device &device, DeviceFilm &to);

} // namespace pt
