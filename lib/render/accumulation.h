// Takes samples into the films of a context's devices: they are dealt out in slices of tiles, and every sample that has
// been begun is completed. The caller of run() deals; between its calls the devices go on alone with what they have.
// One for each call of pt_accumulate or pt_start, owned by Renderer.
#pragma once

#include "lib/film/tile_samples.h"
#include "lib/render/render_device.h"
#include "lib/render/tile_tasks.h"

#include <pt/pt.h>

#include <atomic>
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

// Whether samples are under way, and whether somebody wants no more of them. The one part of a context that every
// thread may touch at any time. Owned by Renderer.
class Cancellation {
public:
    void begin() noexcept { state_ = State::UnderWay; }
    void end() noexcept { state_ = State::Idle; }

    // False if nothing is under way.
    bool ask() noexcept {
        State state = State::UnderWay;
        return state_.compare_exchange_strong(state, State::Asked) || state == State::Asked;
    }

    bool is_asked() const noexcept { return state_ == State::Asked; }

private:
    enum class State { Idle, UnderWay, Asked };
    std::atomic<State> state_{State::Idle};
};

// Totals for all submissions that have been waited for, on all devices.
struct DeviceWork {
    std::uint64_t submit_count = 0;
    double seconds = 0.0;
};

class Accumulation {
public:
    using Clock = std::chrono::steady_clock;

    // Devices, cancellation and work must outlive it. samples: those already in the films. wanted: at most how many
    // will be added, tiles times samples, for the progress.
    Accumulation(const RenderDevices &devices, TileSamples samples, std::uint32_t first_sample, std::uint64_t wanted,
                 const Progress &progress, const Cancellation &cancellation, DeviceWork &work);
    Accumulation(const Accumulation &) = delete;
    Accumulation &operator=(const Accumulation &) = delete;

    // Sets the next goal (TileTasks). False if no tile has fewer samples than it is to have. unit_of_error: the unit of
    // the films, if their error is to be looked at afterwards. Only while nothing is under way.
    bool set_goal(std::span<const std::uint32_t> tiles, const TileTasks::Goal &goal);
    bool set_goal_of_all(const TileTasks::Goal &goal) { return set_goal(all_tiles_, goal); }
    bool set_goal_of_all(std::uint64_t goal, std::optional<double> unit_of_error);

    // Takes the samples, or fewer if it is stopped. Returns false if they are still under way at this time; call it
    // again then.
    bool run(Clock::time_point until);

    bool is_under_way() const;

    // From here on nothing new is begun, except to complete samples that some tiles have begun.
    void stop() { stopped_ = true; }
    bool stopped() const { return stopped_; }

    // To be called after a call has thrown: completes what has been begun, so that the films hold whole samples.
    // Returns false if that fails too; then the films are void, and nothing is under way.
    bool complete() noexcept;

    // The share of the wanted samples that is done, in [0, 1].
    double fraction() const;

    // The samples in the films. Only while nothing is under way.
    const TileSamples &samples() const { return samples_; }

    // Whether the submission with the last samples has estimated the error too, which saves a submission. Only a single
    // device does that.
    bool has_estimate() const { return has_estimate_; }

private:
    // A slice that the devices start one after the other. If one of them fails to, complete() continues from there.
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

    const RenderDevices &devices_;
    DeviceWork &work_;
    Progress progress_;
    const Cancellation &cancellation_;
    std::uint64_t wanted_;
    std::uint64_t done_ = 0;
    TileSamples samples_; // that the films hold or have begun
    std::vector<std::uint32_t> all_tiles_;
    std::uint32_t first_sample_;
    TileTasks tasks_;
    std::optional<double> unit_of_error_;
    std::optional<Begun> begun_; // of the tasks
    bool has_estimate_ = false;
    bool stopped_ = false; // by the caller, or by a failure
};

} // namespace pt
