// Adds samples to the films of devices, in slices of tiles. Every sample that has begun is completed. Only run() starts
// slices.
#pragma once

#include "lib/film/stopping.h"
#include "lib/film/tile_samples.h"
#include "lib/render/render_device.h"
#include "lib/render/tile_tasks.h"

#include <pt/pt.h>

#include <atomic>
#include <chrono>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

namespace pt {

struct Progress {
    pt_progress_fn function;
    void *user;
};

// Thread-safe: pt_cancel may use it while another thread is in a call.
class Cancellation {
public:
    void begin() noexcept { state_ = State::UnderWay; }
    void end() noexcept { state_ = State::Idle; }

    // Returns false if nothing is running.
    bool ask() noexcept {
        State state = State::UnderWay;
        return state_.compare_exchange_strong(state, State::Asked) || state == State::Asked;
    }

    bool is_asked() const noexcept { return state_ == State::Asked; }

private:
    enum class State { Idle, UnderWay, Asked };
    std::atomic<State> state_{State::Idle};
};

struct DeviceWork {
    std::uint64_t submit_count = 0;
    double seconds = 0.0;
};

class Accumulation {
public:
    using Clock = std::chrono::steady_clock;

    // `samples` are already in the films. `wanted` is the largest number of samples to be added, summed over tiles.
    Accumulation(const RenderDevices &devices, TileSamples samples, std::uint32_t first_sample, std::uint64_t wanted,
                 const Progress &progress, const Stopping &stopping, const Cancellation &cancellation,
                 DeviceWork &work);
    Accumulation(const Accumulation &) = delete;
    Accumulation &operator=(const Accumulation &) = delete;

    // Returns false if all tiles have reached the goal. `unit_of_error` is the films' unit if their error will be read
    // afterwards. Nothing may be running.
    bool set_goal(std::span<const std::uint32_t> tiles, const TileTasks::Goal &goal);
    bool set_goal_of_all(const TileTasks::Goal &goal) { return set_goal(all_tiles_, goal); }
    bool set_goal_of_all(std::uint64_t goal, std::optional<double> unit_of_error);

    // Returns false if samples are still running at `until`. The caller must then call again.
    bool run(Clock::time_point until);

    bool is_under_way() const;

    // PT_OK, or the result of a call that no longer begins samples.
    pt_result stopped() const { return stopped_; }

    // Completes begun samples after an exception. If this fails too, returns false, and the films are invalid. Nothing
    // is running afterwards.
    bool complete() noexcept;

    double fraction() const;

    // Nothing may be running.
    const TileSamples &samples() const { return samples_; }

    // Whether the last submission also estimated the error.
    bool has_estimate() const { return has_estimate_; }

private:
    // A slice that starts on one device after another. If a device fails, complete() continues with that device.
    struct Begun {
        TileSlice slice;
        const RenderDevice *taker;
        TileSamples samples;
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
    Stopping stopping_;
    const Cancellation &cancellation_;
    std::uint64_t wanted_;
    std::uint64_t done_ = 0;
    TileSamples samples_;
    std::vector<std::uint32_t> all_tiles_;
    std::uint32_t first_sample_;
    TileTasks tasks_;
    std::optional<double> unit_of_error_;
    std::optional<Begun> begun_;
    bool has_estimate_ = false;
    pt_result stopped_ = PT_OK;
};

} // namespace pt
