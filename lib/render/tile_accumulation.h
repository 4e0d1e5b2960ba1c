// Samples for some tiles on their way into the films of a context's devices.
#pragma once

#include "lib/film/tile_samples.h"
#include "lib/render/sample_dealing.h"

#include <cstddef>
#include <cstdint>
#include <functional>
#include <optional>
#include <span>
#include <vector>

namespace pt {

class TileAccumulation : public SampleDealing {
public:
    // Devices, cancellation and work must outlive it. samples: those that the films hold.
    TileAccumulation(const Devices &devices, const TileSamples &samples, std::uint32_t first_sample,
                     const Amount &amount, const Progress &progress, const Cancellation &cancellation,
                     DeviceWork &work);

    // Sets what is to be done next: those of the tiles that have fewer samples than they are to have take more, as far
    // as a part of the film stays the same: some may have fewer than that afterwards, and are to be set again. False if
    // none has fewer. goal: by number of samples that a tile has, how many it is to have.
    bool set_goal(std::span<const std::uint32_t> tiles, const std::function<std::uint64_t(std::uint32_t)> &goal);

    // Takes these samples, or fewer if it was stopped. False if they are still under way at a time; it is to be called
    // again then.
    bool run(Clock::time_point until);

    // Those that the films hold. Nothing may be under way.
    const TileSamples &tidy_samples();

private:
    // Tiles with equal samples that take the same ones.
    struct Task {
        std::uint32_t set = 0;            // that they have, by TileSamples
        std::uint64_t wanted = 0;         // samples that they are to have
        std::vector<std::uint32_t> tiles; // ascending
        SampleRange before;               // from the first to the last sample that they have
        SampleRange samples;              // to be taken
        SampleRange chunk;                // of these, that which tiles take now
        std::size_t next_tile = 0;        // that takes it next
    };

    // A slice that the devices start one after the other. Where one fails to, complete() goes on from there.
    struct Begun {
        TileSlice slice;
        const RenderDevice *taker; // of its samples
        TileSamples samples;       // with those of the slice
        std::size_t next_device = 0;
        bool is_partly_started = false;
    };

    Task &task_of(std::uint32_t set, std::uint64_t wanted);
    void deal() override;
    bool deal_to(RenderDevice &device);
    void start_begun();
    void leave_behind(std::size_t tile_count);

    TileSamples samples_; // that the films hold or have begun
    std::uint32_t first_sample_;
    std::vector<Task> tasks_;    // the last is under way
    std::optional<Begun> begun_; // of the last task
};

} // namespace pt
