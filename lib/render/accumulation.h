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

    // Takes samples until the films have as many, or fewer if it was stopped. False if that is still under way at a
    // time; it is to be called again then, with the same count.
    bool run(std::uint64_t count, Clock::time_point until);

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
    RenderDevice *next_to_finish(Clock::time_point until) const;
    void finish_slice(RenderDevice &device);

    const Devices &devices_;
    DeviceWork &work_;
    Progress progress_;
    std::uint32_t first_sample_;
    SampleSet dealt_; // those that the films hold or have begun
    std::uint64_t count_ = 0;
    std::uint64_t pixels_wanted_;   // pixels times samples
    std::uint64_t pixels_done_ = 0; // of them
    bool stopped_ = false;          // by the caller, or by a failure
};

} // namespace pt
