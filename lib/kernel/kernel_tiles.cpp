// Samples of some tiles of the film; see kernel.h.
#include "lib/film/host_fold.h"
#include "lib/film/tile_grid.h"
#include "lib/kernel/kernel.h"

#include <algorithm>
#include <utility>

namespace pt {

namespace {

// Invocations that share the samples of a pixel, so that a few tiles keep the device busy.
std::uint32_t sharers_of_tiles(const vulkan::Device &device, std::size_t tile_count, std::uint32_t sample_count) {
    constexpr std::uint32_t least_samples = 4; // of each, which makes its adding to the film worth it
    const std::size_t sharers = device.policy().invocations / (tile_count * gpu::WORKGROUP_SIZE);
    return static_cast<std::uint32_t>(std::clamp<std::size_t>(sharers, 1, std::max(sample_count / least_samples, 1U)));
}

// Row by row, those of tiles side by side at once.
std::vector<PixelRange> pixels_of_tiles(const TileGrid &grid, std::span<const std::uint32_t> tiles) {
    std::vector<PixelRange> ranges;
    for (std::size_t i = 0; i < tiles.size();) {
        Rectangle side_by_side = grid.pixels(tiles[i]);
        for (++i; i < tiles.size() && tiles[i] == tiles[i - 1] + 1 && grid.pixels(tiles[i]).x > 0; ++i)
            side_by_side.width += grid.pixels(tiles[i]).width;
        for (std::uint32_t row = 0; row < side_by_side.height; ++row)
            ranges.push_back({(side_by_side.y + row) * grid.width + side_by_side.x, side_by_side.width});
    }
    return ranges;
}

} // namespace

static_assert(gpu::TILE_SIZE * gpu::TILE_SIZE == gpu::WORKGROUP_SIZE);

void Kernel::prepare_tiles() {
    pipelines_.fold_tiles();
    if (!tile_sets_.empty())
        return;
    if (!tile_lists_)
        tile_lists_.emplace(device_, vulkan::BufferUse::HostWritten,
                            film_.grid().count() * device_.policy().queue_depth * sizeof(std::uint32_t),
                            "lists of tiles");
    const vulkan::ComputePipeline &fold = pipelines_.fold_tiles();
    std::vector<vulkan::DescriptorSet> sets; // none is kept if one fails
    for (const DeviceFilm::Strip &strip : film_.strips())
        sets.push_back(bound(fold, strip, strip.words));
    tile_sets_ = std::move(sets);
}

// Returns the first of the entries. There is a list for each slice that may be under way.
std::uint32_t Kernel::list_tiles(std::span<const std::uint32_t> tiles) {
    const TileGrid grid = film_.grid();
    const std::uint32_t first = next_tile_list_ * static_cast<std::uint32_t>(grid.count());
    next_tile_list_ = (next_tile_list_ + 1) % device_.policy().queue_depth;
    auto *const entries = reinterpret_cast<std::uint32_t *>(tile_lists_->host_memory().data()) + first;
    auto strip = film_.strips().begin();
    for (std::size_t i = 0; i < tiles.size(); ++i) {
        const Rectangle pixels = grid.pixels(tiles[i]);
        const std::uint32_t corner = pixels.y * film_.width() + pixels.x;
        while (corner - strip->first_pixel >= strip->pixel_count)
            ++strip;
        entries[i] = corner - strip->first_pixel;
    }
    return first;
}

// Over the tiles that lie in each strip.
void Kernel::dispatch_tiles(const vk::raii::CommandBuffer &commands, const vulkan::ComputePipeline &pipeline,
                            std::span<const std::uint32_t> tiles, std::uint32_t first_entry, gpu::FrameConstants frame,
                            std::uint32_t table_offset, std::uint32_t sharers) const {
    const TileGrid grid = film_.grid();
    for (std::size_t i = 0; i < tile_sets_.size(); ++i) {
        const DeviceFilm::Strip &strip = film_.strips()[i];
        const std::uint64_t strip_end = std::uint64_t{strip.first_pixel} + strip.pixel_count;
        const auto end = std::ranges::partition_point(
            tiles, [&](std::uint32_t tile) { return std::uint64_t{grid.pixels(tile).y} * grid.width < strip_end; });
        const auto count = static_cast<std::uint32_t>(end - tiles.begin());
        if (count == 0)
            continue;
        frame.strip_first_pixel = first_pixel_ + strip.first_pixel;
        frame.strip_pixel_count = strip.pixel_count;
        frame.first_pixel = first_entry;
        pipeline.dispatch(commands, tile_sets_[i], std::as_bytes(std::span(&frame, 1)), count, {{table_offset}},
                          sharers);
        tiles = tiles.subspan(count);
        first_entry += count;
    }
}

vulkan::Device::Ticket Kernel::start_tiles(const TileWork &work) {
    prepare_tiles();
    upload_scene();
    std::vector<Batch> batches;
    for (std::uint64_t sample = work.samples.first; sample < work.samples.end; sample = batches.back().range().end)
        batches.push_back(
            next_batch({sample, std::min<std::uint64_t>(sample + max_dispatch_samples_, work.samples.end)}));
    upload_points(batches);
    const std::uint32_t first_entry = list_tiles(work.tiles);
    const vulkan::ComputePipeline *const trace =
        batches.empty() ? nullptr
                        : &pipelines_.trace(features_, TracePipelines::of_tile_list, gpu_scene_->words, seconds_);
    HostFold host_fold(film_, 1 - work.target.part);
    const bool is_folded = work.fold_into == 1 - work.target.part && work.target.is_empty && folds_on_host() &&
                           host_fold.fold(pixels_of_tiles(film_.grid(), work.tiles));
    const vulkan::Device::Ticket ticket = device_.start([&](const vk::raii::CommandBuffer &commands) {
        gpu::FrameConstants frame = frame_;
        if (scene_is_old_) {
            scene_.write(commands, std::as_bytes(std::span(gpu_scene_->words)));
            vulkan::barrier_between_commands(commands);
        }
        frame.is_first = overwrites(work.target);
        if (work.fold_into && !is_folded) {
            frame.film_part = *work.fold_into;
            dispatch_tiles(commands, pipelines_.fold_tiles(), work.tiles, first_entry, frame, 0, 1);
            vulkan::barrier_between_commands(commands);
        }
        frame.film_part = work.target.part;
        for (const Batch &batch : batches) {
            if (&batch != &batches.front() && !overlap_)
                vulkan::barrier_between_commands(commands);
            frame.first_sample = batch.first_sample;
            frame.sample_count = batch.sample_count;
            dispatch_tiles(commands, *trace, work.tiles, first_entry, frame, batch.table_offset,
                           sharers_of_tiles(device_, work.tiles.size(), batch.sample_count));
            frame.is_first = 0;
        }
    });
    host_fold.keep();
    scene_is_old_ = false;
    return ticket;
}

} // namespace pt
