#pragma once

#include "lib/film/pixel_sums.h"
#include "lib/kernel/device_film.h"

#include <algorithm>
#include <cstdint>
#include <span>

// `words` has the planes of part 0 (older), then of part 1.
inline pt::PixelSums sums_of(std::span<const std::uint32_t> words, std::size_t pixel_count) {
    pt::PixelSums sums;
    sums.resize(pixel_count);
    for (std::uint32_t part = 0; part < pt::gpu::FILM_PARTS; ++part)
        for (std::size_t plane = 0; plane < pt::gpu::FILM_WORDS; ++plane)
            std::ranges::copy(words.subspan((part * pt::gpu::FILM_WORDS + plane) * pixel_count, pixel_count),
                              sums.plane(part, plane).begin());
    return sums;
}

inline void fill(pt::vulkan::Device &device, pt::DeviceFilm &film, const pt::PixelSums &sums) {
    pt::DeviceFilm::NewSums filled(device, film);
    filled.write(0, sums);
    filled.replace();
}
