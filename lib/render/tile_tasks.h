// The work of tiles on the way to the samples that they are to have, slice by slice. It knows no device: Accumulation
// asks for the next slice and has a device take it.
#pragma once

#include "lib/film/tile_samples.h"
#include "lib/kernel/tile_slice.h"
#include "lib/render/schedule.h"

#include <cstddef>
#include <cstdint>
#include <functional>
#include <span>
#include <vector>

namespace pt {

class TileTasks {
public:
    // How many samples a pixel of a tile is to have.
    using Goal = std::function<std::uint64_t(std::uint32_t)>;

    // Tiles, in ascending order, that have fewer samples than their goal take the next ones that they lack, from
    // first_sample on, as far as those are consecutive. So some may still have too few afterwards, and a new goal has
    // to be set for them.
    TileTasks(const TileSamples &present, std::uint32_t first_sample, std::span<const std::uint32_t> tiles,
              const Goal &goal);

    // The same for all tiles when all have the same samples; the list of tiles must outlive it. It takes no longer for
    // many tiles.
    TileTasks(const SampleSet &present, std::uint32_t first_sample, std::span<const std::uint32_t> all_tiles,
              std::uint64_t goal);

    TileTasks() = default;

    bool empty() const { return tasks_.empty(); }

    // Whether some tiles have begun samples that others, which had the same samples before, have not begun yet.
    bool is_within_samples() const { return !empty() && tasks_.back().next_tile > 0; }

    // The next slice, as large as the schedule of its device allows. Must not be empty().
    TileSlice next(const Schedule &schedule);

    // Whether a slice with this many tiles is the last one for its samples, or for all.
    bool ends_samples(std::size_t tile_count) const;
    bool ends_all(std::size_t tile_count) const;

    // The slice has been begun.
    void leave_behind(std::size_t tile_count) noexcept;

private:
    // Tiles with equal samples, which take the same ones.
    struct Task {
        std::uint32_t set;    // that they have, by TileSamples
        std::uint64_t wanted; // samples that they are to have
        SampleRange before;   // from the first to the last sample that they have
        SampleRange samples;  // to be taken
        SampleRange chunk{};  // of these, that which tiles take now
        std::vector<std::uint32_t> found{};
        std::span<const std::uint32_t> tiles{}; // ascending: these, or all
        std::size_t next_tile = 0;              // that takes the chunk next
    };

    Task &add_task(std::uint32_t set, std::uint64_t wanted, const SampleSet &present, std::uint32_t first_sample);

    std::vector<Task> tasks_; // the last is under way
};

} // namespace pt
