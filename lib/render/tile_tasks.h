// What tiles take on the way to the samples that they are to have, slice by slice. No device in here: Accumulation asks
// for the next slice and has a device take it.
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
    // By tile how many samples a pixel is to have.
    using Goal = std::function<std::uint64_t(std::uint32_t)>;

    // From first_sample on, those of the tiles, which ascend, that have fewer samples than they are to have take the
    // next that they have not, as far as these are consecutive: some may have fewer than that afterwards, and are to be
    // set again.
    TileTasks(const TileSamples &present, std::uint32_t first_sample, std::span<const std::uint32_t> tiles,
              const Goal &goal);

    // The same of all tiles, which have the same samples; the list of them must outlive it. So it takes no longer for
    // many tiles.
    TileTasks(const SampleSet &present, std::uint32_t first_sample, std::span<const std::uint32_t> all_tiles,
              std::uint64_t goal);

    TileTasks() = default;

    bool empty() const { return tasks_.empty(); }

    // Whether some tiles have begun samples that others, which had the same until then, have still to begin.
    bool is_within_samples() const { return !empty() && tasks_.back().next_tile > 0; }

    // As much of what is next as the schedule of the device that takes it allows. There is something.
    TileSlice next(const Schedule &schedule);

    // Whether a slice of so many tiles is the last of its samples, or of all.
    bool ends_samples(std::size_t tile_count) const;
    bool ends_all(std::size_t tile_count) const;

    // It has been begun.
    void leave_behind(std::size_t tile_count) noexcept;

private:
    // Tiles with equal samples that take the same ones.
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
