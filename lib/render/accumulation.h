// Takes samples into the films of a context's devices, in slices of tiles. Every begun sample is completed. Only run()
// starts slices; between calls devices work on alone. One per pt_accumulate or pt_start, owned by Renderer.
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

struct Progress {
    pt_progress_fn function; // may be NULL
    void *user;
};

// Whether samples are under way or cancelled. The only part of a context that any thread may touch at any time.
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

// Totals over finished submissions on all devices.
struct DeviceWork {
    std::uint64_t submit_count = 0;
    double seconds = 0.0;
};

class Accumulation {
public:
    using Clock = std::chrono::steady_clock;

    // samples: in the films already. wanted: at most, tiles times samples, for the progress.
    Accumulation(const RenderDevices &devices, TileSamples samples, std::uint32_t first_sample, std::uint64_t wanted,
                 const Progress &progress, const Cancellation &cancellation, DeviceWork &work);
    Accumulation(const Accumulation &) = delete;
    Accumulation &operator=(const Accumulation &) = delete;

    // Sets the next goal (TileTasks); false if every tile has reached it. unit_of_error: the films' unit, if their
    // error will be read afterwards. Only while nothing is under way.
    bool set_goal(std::span<const std::uint32_t> tiles, const TileTasks::Goal &goal);
    bool set_goal_of_all(const TileTasks::Goal &goal) { return set_goal(all_tiles_, goal); }
    bool set_goal_of_all(std::uint64_t goal, std::optional<double> unit_of_error);

    // Takes the samples, or fewer if stopped. Returns false if they are still under way at `until`; call again then.
    bool run(Clock::time_point until);

    bool is_under_way() const;

    // Begins nothing new, except to complete begun samples.
    void stop() { stopped_ = true; }
    bool stopped() const { return stopped_; }

    // Call after an exception: completes begun samples, so that the films hold whole ones. If that fails too, returns
    // false; the films are then void, and nothing is under way.
    bool complete() noexcept;

    // Done share, in [0, 1].
    double fraction() const;

    // In the films. Only while nothing is under way.
    const TileSamples &samples() const { return samples_; }

    // Whether the last submission has estimated the error too. Only with a single device.
    bool has_estimate() const { return has_estimate_; }

private:
    // Started on one device after the other. If one fails, complete() continues from there.
    struct Begun {
        TileSlice slice;
        const RenderDevice *taker; // takes the slice's samples
        TileSamples samples;       // including the slice's
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
    TileSamples samples_; // samples in the films or begun
    std::vector<std::uint32_t> all_tiles_;
    std::uint32_t first_sample_;
    TileTasks tasks_;
    std::optional<double> unit_of_error_;
    std::optional<Begun> begun_;
    bool has_estimate_ = false;
    bool stopped_ = false; // the caller or a failure stopped it
};

} // namespace pt
