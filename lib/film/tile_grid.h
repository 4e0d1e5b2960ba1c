// Square tiles of TILE_SIZE pixels, row by row. Tiles at the edges may be smaller.
#pragma once

#include "lib/film/film_header.h"
#include "shaders/gpu_layout.h"

#include <algorithm>
#include <cstddef>
#include <cstdint>

namespace pt {

struct TileGrid {
    std::uint32_t width = 0;
    std::uint32_t height = 0;

    std::uint32_t columns() const { return (width + gpu::TILE_SIZE - 1) / gpu::TILE_SIZE; }
    std::uint32_t rows() const { return (height + gpu::TILE_SIZE - 1) / gpu::TILE_SIZE; }
    std::size_t count() const { return std::size_t{columns()} * rows(); }

    Rectangle pixels(std::size_t tile) const {
        const auto x = static_cast<std::uint32_t>(tile % columns()) * gpu::TILE_SIZE;
        const auto y = static_cast<std::uint32_t>(tile / columns()) * gpu::TILE_SIZE;
        return {x, y, std::min(gpu::TILE_SIZE, width - x), std::min(gpu::TILE_SIZE, height - y)};
    }

    std::size_t tile_at(std::uint32_t x, std::uint32_t y) const {
        return std::size_t{y / gpu::TILE_SIZE} * columns() + x / gpu::TILE_SIZE;
    }

    // Calls function(first, count, tile) for each run of pixels in a row of a tile. `first` is relative to first_pixel.
    template <typename Function>
    void for_each_run(std::uint32_t first_pixel, std::size_t pixel_count, const Function &function) const {
        for (std::size_t done = 0; done < pixel_count;) {
            const std::uint32_t y = (first_pixel + static_cast<std::uint32_t>(done)) / width;
            const std::uint32_t x = (first_pixel + static_cast<std::uint32_t>(done)) % width;
            const std::size_t count =
                std::min<std::size_t>({pixel_count - done, gpu::TILE_SIZE - x % gpu::TILE_SIZE, width - x});
            function(done, count, tile_at(x, y));
            done += count;
        }
    }

    bool operator==(const TileGrid &) const = default;
};

} // namespace pt
