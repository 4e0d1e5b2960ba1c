// Samples on their way into the films of a context's devices: dealt out in slices, in ascending order, none left out
// once it is begun. Whoever calls run() deals; between its calls what has been dealt goes on on the devices alone. One
// per call of pt_accumulate or pt_start, owned by Renderer.
#pragma once

#include "lib/film/sample_set.h"
#include "lib/render/render_device.h"

#include <pt/pt.h>

#include <chrono>
#include <cstdint>
#include <memory>
#include <optional>
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

    // Devices and work must outlive it. samples: those that the films hold. wanted: how many are to be added to them,
    // at the most, which the progress is about.
    Accumulation(const Devices &devices, const SampleSet &samples, std::uint32_t first_sample, std::uint32_t wanted,
                 const Progress &progress, DeviceWork &work);

    // How many samples the films are to have, and whether their error is to be estimated then.
    struct Goal {
        std::uint64_t count;
        std::optional<double> unit_of_error; // of the films, if it is
    };

    // Takes samples until the films have as many, or fewer if it was stopped. False if that is still under way at a
    // time; it is to be called again then, with the same goal.
    bool run(const Goal &goal, Clock::time_point until);

    // Whether the error was estimated in the submission with the last samples, which saves one: on a device that is
    // alone and took them at once.
    bool has_estimate() const { return has_estimate_; }

    bool is_under_way() const;

    // Nothing is begun from here on, but for what completes samples that several devices have begun. Only a device that
    // is alone may stop within a pass, and will go on there.
    void stop() { stopped_ = true; }
    bool stopped() const { return stopped_; }

    // After run() has thrown: completes what has been begun, so that the films hold whole samples. False where that
    // fails too; then they are void, and nothing is under way.
    bool complete() noexcept;

    // The whole samples that the films hold. Nothing may be under way.
    SampleSet samples() const;

    // Share of the wanted samples that are done, in [0, 1].
    double fraction() const;

private:
    void deal();
    bool deal_to(RenderDevice &device);
    std::optional<ErrorQuery> estimate_after(const SampleRange &samples) const;
    RenderDevice *next_to_finish(Clock::time_point until) const;
    void finish_slice(RenderDevice &device);

    const Devices &devices_;
    DeviceWork &work_;
    Progress progress_;
    std::uint32_t first_sample_;
    SampleSet dealt_; // those that the films hold or have begun
    Goal goal_{};
    bool has_estimate_ = false;
    std::uint64_t pixels_wanted_;   // pixels times samples
    std::uint64_t pixels_done_ = 0; // of them
    bool stopped_ = false;          // by the caller, or by a failure
};

} // namespace pt
