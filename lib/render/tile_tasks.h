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
    using Goal = std::function<std::uint64_t(std::uint32_t)>;

    // `tiles` must ascend. Tiles below their goal take the first consecutive samples that they lack, from first_sample
    // on. Further samples need a new goal.
    TileTasks(const TileSamples &present, std::uint32_t first_sample, std::span<const std::uint32_t> tiles,
              const Goal &goal);

    // All tiles must have equal samples.
    TileTasks(const SampleSet &present, std::uint32_t first_sample, std::span<const std::uint32_t> all_tiles,
              std::uint64_t goal);

    TileTasks() = default;

    bool empty() const { return tasks_.empty(); }

    // Whether only some tiles of the present task have begun the task's next samples.
    bool is_within_samples() const { return !empty() && tasks_.back().next_tile > 0; }

    TileSlice next(const Schedule &schedule);

    // Whether a slice of this many tiles is the last one with its samples, or the last of all.
    bool ends_samples(std::size_t tile_count) const;
    bool ends_all(std::size_t tile_count) const;

    void leave_behind(std::size_t tile_count) noexcept;

private:
    struct Task {
        std::uint32_t set;
        std::uint64_t wanted;
        SampleRange before; // hull of present samples
        SampleRange samples;
        SampleRange chunk{}; // samples being taken
        std::vector<std::uint32_t> found{};
        std::span<const std::uint32_t> tiles{}; // ascending; either `found` or all tiles
        std::size_t next_tile = 0;
    };

    Task &add_task(std::uint32_t set, std::uint64_t wanted, const SampleSet &present, std::uint32_t first_sample);

    std::vector<Task> tasks_;
};

} // namespace pt
