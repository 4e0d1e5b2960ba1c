// Samples on their way into the films of a context's devices: dealt out in slices, none left out once it is begun.
// Whoever calls run() deals; between its calls what has been dealt goes on on the devices alone. One per call of
// pt_accumulate or pt_start, owned by Renderer: an Accumulation, or a TileAccumulation.
#pragma once

#include "lib/render/cancellation.h"
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

class SampleDealing {
public:
    using Devices = std::vector<std::unique_ptr<RenderDevice>>;
    using Clock = std::chrono::steady_clock;

    // What the progress is about, in pixels times samples.
    struct Amount {
        std::uint64_t wanted;
        std::uint64_t done = 0; // of them, before
    };

    virtual ~SampleDealing() = default;
    SampleDealing(const SampleDealing &) = delete;
    SampleDealing &operator=(const SampleDealing &) = delete;

    bool is_under_way() const;

    // Nothing is begun from here on, but for what completes samples that several devices have begun. Only a device that
    // is alone may stop within a pass, and will go on there.
    void stop() { stopped_ = true; }
    bool stopped() const { return stopped_; }

    // After a call has thrown: completes what has been begun, so that the films hold whole samples. False where that
    // fails too; then they are void, and nothing is under way.
    bool complete() noexcept;

    // Share of the wanted samples that are done, in [0, 1].
    double fraction() const;
    std::uint64_t pixels_done() const { return amount_.done; }

protected:
    // Devices, cancellation and work must outlive it.
    SampleDealing(const Devices &devices, const Amount &amount, const Progress &progress,
                  const Cancellation &cancellation, DeviceWork &work);

    // Deals, and takes in what ends, until nothing is left. False if something is still under way at a time.
    bool go_on(Clock::time_point until);

    // Starts what there is room for.
    virtual void deal() = 0;

    const Devices &devices() const { return devices_; }

private:
    void deal_unless_cancelled();
    RenderDevice *next_to_finish(Clock::time_point until) const;
    void finish_slice(RenderDevice &device);

    const Devices &devices_;
    DeviceWork &work_;
    Progress progress_;
    const Cancellation &cancellation_;
    Amount amount_;
    bool stopped_ = false; // by the caller, or by a failure
};

} // namespace pt
