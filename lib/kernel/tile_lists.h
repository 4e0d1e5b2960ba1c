// Lists of tiles for dispatches, as kernels read them: the first pixel of each tile, in the film. Owned by Kernel.
#pragma once

#include "lib/film/tile_grid.h"
#include "lib/vulkan/buffer.h"
#include "lib/vulkan/device.h"

#include <cstdint>
#include <span>

namespace pt {

class TileLists {
public:
    // The device must outlive the lists.
    TileLists(vulkan::Device &device, const TileGrid &grid);

    const vulkan::Buffer &buffer() const { return entries_; }

    // The number of the first entry for these tiles, which ascend. It is valid until as many more slices have begun as
    // the device has in its queue (queue_depth).
    std::uint32_t first_entry(std::span<const std::uint32_t> tiles);

private:
    std::span<std::uint32_t> list(std::uint32_t number);

    std::uint32_t tile_count_;
    std::uint32_t slice_lists_;
    std::uint32_t next_list_ = 0; // of those for slices
    vulkan::Buffer entries_;      // a list of all tiles, then those for slices of other tiles than consecutive ones
};

} // namespace pt
