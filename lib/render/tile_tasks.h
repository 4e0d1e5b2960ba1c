// Divides the work on tiles' missing samples into slices. Accumulation asks for the next slice and has a device take
// it.
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
    // Wanted samples of a tile's pixels.
    using Goal = std::function<std::uint64_t(std::uint32_t)>;

    // tiles: ascending. Tiles below their goal take the next samples that they lack, from first_sample on, so far as
    // those are consecutive. Some may then still need a new goal.
    TileTasks(const TileSamples &present, std::uint32_t first_sample, std::span<const std::uint32_t> tiles,
              const Goal &goal);

    // Needs equal samples in all tiles, and takes no longer for many.
    TileTasks(const SampleSet &present, std::uint32_t first_sample, std::span<const std::uint32_t> all_tiles,
              std::uint64_t goal);

    TileTasks() = default;

    bool empty() const { return tasks_.empty(); }

    // Whether only some of a chunk's tiles have begun its samples.
    bool is_within_samples() const { return !empty() && tasks_.back().next_tile > 0; }

    // As large as the device's schedule allows. Must not be empty().
    TileSlice next(const Schedule &schedule);

    // Whether a slice of this many tiles is the last for its samples, or for all.
    bool ends_samples(std::size_t tile_count) const;
    bool ends_all(std::size_t tile_count) const;

    // Call when the slice has been begun.
    void leave_behind(std::size_t tile_count) noexcept;

private:
    // Tiles with equal samples, which take the same ones.
    struct Task {
        std::uint32_t set; // index of their samples in TileSamples
        std::uint64_t wanted;
        SampleRange before; // hull of the samples that they have
        SampleRange samples;
        SampleRange chunk{}; // part of `samples` that tiles take now
        std::vector<std::uint32_t> found{};
        std::span<const std::uint32_t> tiles{}; // ascending: these, or all
        std::size_t next_tile = 0;              // takes the chunk next
    };

    Task &add_task(std::uint32_t set, std::uint64_t wanted, const SampleSet &present, std::uint32_t first_sample);

    std::vector<Task> tasks_; // the last one is under way
};

} // namespace pt
