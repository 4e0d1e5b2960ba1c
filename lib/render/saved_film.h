// Films on their way between devices and bytes. Used by Renderer.
#pragma once

#include "lib/film/device_film.h"
#include "lib/film/film.h"
#include "lib/film/film_bytes.h"
#include "lib/film/tile_samples.h"

#include <cstddef>
#include <span>
#include <vector>

namespace pt {

// Writes the sum of films of one size, which together hold these samples and those of the header, to memory of the size
// that FilmLayout asks for. origin: the pixels of the image that the films have room for; the header may lack some.
void save(std::span<DeviceFilm *const> films, const TileSamples &samples, const FilmHeader &header,
          const Rectangle &origin, std::span<std::byte> bytes);

// Throws PT_ERROR_INCOMPATIBLE if an even film has samples that a context has already.
void require_addable(const FilmReader &film, const SampleSet &present);

// Adds an even film to one in a device's memory, all of it or nothing: throws PT_ERROR_INCOMPATIBLE for sums that its
// samples cannot have; hull: of the samples of both, and of all films that are rendered together.
void add(const FilmReader &film, const SampleRange &hull, vulkan::Device &device, DeviceFilm &to);

// Throws PT_ERROR_INCOMPATIBLE if the pixels of a film do not lie in those of a context.
void require_within(const Rectangle &film, const Rectangle &pixels);

// Makes a film in a device's memory, of these pixels, what a film on the host is. hull: of its samples.
void replace(const Film &by, const SampleRange &hull, const Rectangle &pixels, vulkan::Device &device,
             DeviceFilm &film);

} // namespace pt
