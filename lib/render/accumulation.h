// Samples on their way into the films of a context's devices: dealt out in slices of tiles, none left out once it is
// begun. Whoever calls run() deals; between its calls what has been dealt goes on on the devices alone. One per call of
// pt_accumulate or pt_start, owned by Renderer.
#pragma once

#include "lib/film/tile_samples.h"
#include "lib/render/cancellation.h"
#include "lib/render/render_device.h"
#include "lib/render/tile_tasks.h"

#include <pt/pt.h>

#include <chrono>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <vector>

namespace pt {

// The caller's pt_progress_fn.
struct Progress {
    pt_progress_fn function; // may be NULL
    void *user;
};

// Submissions that have been waited for, of all devices.
struct DeviceWork {
    std::uint64_t submit_count = 0;
    double seconds = 0.0;
};

class Accumulation {
public:
    using Devices = std::vector<std::unique_ptr<RenderDevice>>;
    using Clock = std::chrono::steady_clock;

    // Devices, cancellation and work must outlive it. samples: those that the films hold. wanted: how many are to be
    // added to them, at the most, tiles times samples, which the progress is about.
    Accumulation(const Devices &devices, TileSamples samples, std::uint32_t first_sample, std::uint64_t wanted,
                 const Progress &progress, const Cancellation &cancellation, DeviceWork &work);
    Accumulation(const Accumulation &) = delete;
    Accumulation &operator=(const Accumulation &) = delete;

    // Set what is to be done next (TileTasks). False if no tile has fewer samples than it is to have. unit_of_error: of
    // the films, if their error is to be looked at next. Nothing may be under way.
    bool set_goal(std::span<const std::uint32_t> tiles, const TileTasks::Goal &goal);
    bool set_goal_of_all(std::span<const std::uint32_t> all_tiles, std::uint64_t goal,
                         std::optional<double> unit_of_error);

    // Takes these samples, or fewer if it was stopped. False if they are still under way at a time; it is to be called
    // again then.
    bool run(Clock::time_point until);

    bool is_under_way() const;

    // Nothing is begun from here on, but for what completes samples that some of the tiles have begun.
    void stop() { stopped_ = true; }
    bool stopped() const { return stopped_; }

    // After a call has thrown: completes what has been begun, so that the films hold whole samples. False where that
    // fails too; then they are void, and nothing is under way.
    bool complete() noexcept;

    // Share of the wanted samples that are done, in [0, 1].
    double fraction() const;

    // Those that the films hold. Nothing may be under way.
    const TileSamples &samples() const { return samples_; }

    // Whether the error of the films was estimated in the submission with the last samples, which saves one: where the
    // only device does that.
    bool has_estimate() const { return has_estimate_; }

private:
    // A slice that the devices start one after the other. Where one fails to, complete() goes on from there.
    struct Begun {
        TileSlice slice;
        const RenderDevice *taker; // of its samples
        TileSamples samples;       // with those of the slice
        bool is_estimated;
        std::size_t next_device = 0;
        bool is_partly_started = false;
    };

    bool set(TileTasks tasks, std::optional<double> unit_of_error);
    void deal();
    bool deal_to(RenderDevice &device);
    bool has_room_for(const TileSlice &slice, const RenderDevice &taker) const;
    void start_begun();
    RenderDevice *next_to_finish(Clock::time_point until) const;
    void finish_slice(RenderDevice &device);

    const Devices &devices_;
    DeviceWork &work_;
    Progress progress_;
    const Cancellation &cancellation_;
    std::uint64_t wanted_;
    std::uint64_t done_ = 0;
    TileSamples samples_; // that the films hold or have begun
    std::uint32_t first_sample_;
    TileTasks tasks_;
    std::optional<double> unit_of_error_;
    std::optional<Begun> begun_; // of the tasks
    bool has_estimate_ = false;
    bool stopped_ = false; // by the caller, or by a failure
};

} // namespace pt
