// Lists of tiles for dispatches. An entry is the index of a tile's first pixel in the film.
#pragma once

#include "lib/film/tile_grid.h"
#include "lib/vulkan/buffer.h"
#include "lib/vulkan/device.h"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <span>

namespace pt {

class TileLists {
public:
    TileLists(vulkan::Device &device, const TileGrid &grid) :
        tile_count_(static_cast<std::uint32_t>(grid.count())),
        slice_lists_(device.policy().queue_depth),
        entries_(device, vulkan::BufferUse::HostWritten,
                 std::uint64_t{1 + slice_lists_} * tile_count_ * sizeof(std::uint32_t), "lists of tiles") {
        auto entry = list(0).begin();
        for (std::uint32_t y = 0; y < grid.height; y += gpu::TILE_SIZE)
            for (std::uint32_t x = 0; x < grid.width; x += gpu::TILE_SIZE)
                *entry++ = y * grid.width + x;
    }

    const vulkan::Buffer &buffer() const { return entries_; }

    // Tiles must ascend. The list is valid until queue_depth more slices have begun.
    std::uint32_t first_entry(std::span<const std::uint32_t> tiles) {
        if (tiles.back() - tiles.front() == tiles.size() - 1)
            return tiles.front();
        const std::uint32_t number = 1 + next_list_;
        next_list_ = (next_list_ + 1) % slice_lists_;
        std::ranges::transform(tiles, list(number).begin(), [all = list(0)](std::uint32_t tile) { return all[tile]; });
        return number * tile_count_;
    }

private:
    std::span<std::uint32_t> list(std::uint32_t number) const {
        auto *const first = reinterpret_cast<std::uint32_t *>(entries_.host_memory().data());
        return {first + std::size_t{number} * tile_count_, tile_count_};
    }

    std::uint32_t tile_count_;
    std::uint32_t slice_lists_;
    std::uint32_t next_list_ = 0;
    vulkan::Buffer entries_;
};

} // namespace pt
