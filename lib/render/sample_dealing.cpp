// Deals samples, and takes them in; see sample_dealing.h.
#include "lib/render/sample_dealing.h"

#include <algorithm>
#include <thread>

namespace pt {

SampleDealing::SampleDealing(const Devices &devices, const Amount &amount, const Progress &progress,
                             const Cancellation &cancellation, DeviceWork &work) :
    devices_(devices),
    work_(work),
    progress_(progress),
    cancellation_(cancellation),
    amount_(amount) {}

// Where the time is over, what has ended by now is taken in before anything is dealt, and what is dealt is left to the
// next call: so a call comes to an end however short the slices are, and one that finds nothing under way waits for
// nothing.
bool SampleDealing::go_on(Clock::time_point until) {
    const bool begins = !is_under_way();
    for (const auto &device : devices_)
        device->look();
    deal_unless_cancelled();
    if (begins && Clock::now() >= until)
        return !is_under_way();
    while (RenderDevice *const device = next_to_finish(until)) {
        finish_slice(*device);
        if (Clock::now() < until)
            deal_unless_cancelled();
    }
    deal_unless_cancelled();
    return !is_under_way();
}

// It may be asked for at any time, and counts from here on.
void SampleDealing::deal_unless_cancelled() {
    if (cancellation_.is_asked())
        stop();
    deal();
}

bool SampleDealing::is_under_way() const {
    return std::ranges::any_of(devices_, [](const auto &device) { return !device->is_idle(); });
}

bool SampleDealing::complete() noexcept {
    stop();
    try {
        return go_on(Clock::time_point::max());
    } catch (...) {
        for (const auto &device : devices_)
            device->drain();
        return false;
    }
}

double SampleDealing::fraction() const {
    return std::min(static_cast<double>(amount_.done) / static_cast<double>(amount_.wanted), 1.0);
}

// The device whose slice ends first, if one does by that time. Of several it is the first that is seen to be done, for
// Vulkan waits for no more than one.
RenderDevice *SampleDealing::next_to_finish(Clock::time_point until) const {
    constexpr std::chrono::microseconds pause{50}; // a thousandth of a slice
    if (devices_.size() == 1)
        return !devices_.front()->is_idle() && devices_.front()->is_done(until) ? devices_.front().get() : nullptr;
    while (is_under_way()) {
        for (const auto &device : devices_)
            if (!device->is_idle() && device->is_done(Clock::time_point::min()))
                return device.get();
        if (Clock::now() >= until)
            return nullptr;
        std::this_thread::sleep_for(pause);
    }
    return nullptr;
}

void SampleDealing::finish_slice(RenderDevice &device) {
    const auto [paths, seconds] = device.finish();
    ++work_.submit_count;
    work_.seconds += seconds;
    amount_.done += paths;
    if (progress_.function && !stopped_)
        stopped_ = progress_.function(progress_.user, fraction()) != 0;
}

} // namespace pt
