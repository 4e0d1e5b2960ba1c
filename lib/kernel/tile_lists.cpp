#include "lib/kernel/tile_lists.h"

#include <algorithm>
#include <cstddef>

namespace pt {

TileLists::TileLists(vulkan::Device &device, const TileGrid &grid) :
    tile_count_(static_cast<std::uint32_t>(grid.count())),
    slice_lists_(device.policy().queue_depth),
    entries_(device, vulkan::BufferUse::HostWritten,
             std::uint64_t{1 + slice_lists_} * tile_count_ * sizeof(std::uint32_t), "lists of tiles") {
    auto entry = list(0).begin();
    for (std::uint32_t y = 0; y < grid.height; y += gpu::TILE_SIZE)
        for (std::uint32_t x = 0; x < grid.width; x += gpu::TILE_SIZE)
            *entry++ = y * grid.width + x;
}

std::span<std::uint32_t> TileLists::list(std::uint32_t number) {
    auto *const first = reinterpret_cast<std::uint32_t *>(entries_.host_memory().data());
    return {first + std::size_t{number} * tile_count_, tile_count_};
}

std::uint32_t TileLists::first_entry(std::span<const std::uint32_t> tiles) {
    if (tiles.back() - tiles.front() == tiles.size() - 1)
        return tiles.front();
    const std::uint32_t number = 1 + next_list_;
    next_list_ = (next_list_ + 1) % slice_lists_;
    std::ranges::transform(tiles, list(number).begin(), [all = list(0)](std::uint32_t tile) { return all[tile]; });
    return number * tile_count_;
}

} // namespace pt
