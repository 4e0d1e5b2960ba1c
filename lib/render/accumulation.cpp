// Deals samples, and takes them in; see accumulation.h.
#include "lib/render/accumulation.h"

#include <algorithm>
#include <thread>

namespace pt {

Accumulation::Accumulation(const Devices &devices, const SampleSet &samples, std::uint32_t first_sample,
                           std::uint32_t wanted, const Progress &progress, DeviceWork &work) :
    devices_(devices),
    work_(work),
    progress_(progress),
    first_sample_(first_sample),
    dealt_(samples),
    pixels_wanted_(std::uint64_t{wanted} * devices.front()->pixel_count() - devices.front()->pass_pixels()) {
    if (const SampleRange pass = devices.front()->pass(); !pass.empty())
        dealt_.add(pass);
}

// Where the time is over, what has ended by now is taken in before anything is dealt, and what is dealt is left to the
// next call: so a call comes to an end however short the slices are, and one that finds nothing under way waits for
// nothing.
bool Accumulation::run(const Goal &goal, Clock::time_point until) {
    goal_ = goal;
    const bool begins = !is_under_way();
    for (const auto &device : devices_)
        device->look();
    deal();
    if (begins && Clock::now() >= until)
        return !is_under_way();
    while (RenderDevice *const device = next_to_finish(until)) {
        finish_slice(*device);
        if (Clock::now() < until)
            deal();
    }
    deal();
    return !is_under_way();
}

bool Accumulation::is_under_way() const {
    return std::ranges::any_of(devices_, [](const auto &device) { return !device->is_idle(); });
}

bool Accumulation::complete() noexcept {
    stop();
    try {
        return run({goal_.count, std::nullopt}, Clock::time_point::max());
    } catch (...) {
        for (const auto &device : devices_)
            device->drain();
        return false;
    }
}

SampleSet Accumulation::samples() const {
    SampleSet whole = dealt_;
    if (const SampleRange pass = devices_.front()->pass(); !pass.empty())
        whole.remove(pass);
    return whole;
}

double Accumulation::fraction() const {
    return std::min(static_cast<double>(pixels_done_) / static_cast<double>(pixels_wanted_), 1.0);
}

void Accumulation::deal() {
    for (const auto &device : devices_)
        while (deal_to(*device)) {
        }
}

// Starts a device's next slice, if it has room for one and there is one.
bool Accumulation::deal_to(RenderDevice &device) {
    const bool finishes_pass = !device.pass().empty() && !(stopped_ && devices_.size() == 1);
    const bool goes_on =
        !stopped_ && (device.film_is_behind() || (device.pass().empty() && dealt_.count() < goal_.count));
    if (!device.has_room() || !(finishes_pass || goes_on))
        return false;
    SampleRange next = dealt_.next_missing(first_sample_);
    next.end = std::min(next.end, next.first + (goal_.count - std::min(goal_.count, dealt_.count())));
    dealt_.prepare_add(); // what is started must be counted
    const auto [begun, estimates] = device.start(next, dealt_.hull(), estimate_after(next));
    dealt_.add({next.first, next.first + begun});
    has_estimate_ = estimates;
    return true;
}

// Of the films with these samples, if they are the last ones. What a device tells of its own film alone is no use.
std::optional<ErrorQuery> Accumulation::estimate_after(const SampleRange &samples) const {
    if (!goal_.unit_of_error || devices_.size() > 1 || dealt_.count() + samples.count() < goal_.count)
        return std::nullopt;
    SampleSet all = dealt_;
    all.add(samples);
    return ErrorQuery{*goal_.unit_of_error, part_counts(all)};
}

// The device whose slice ends first, if one does by that time. Of several it is the first that is seen to be done, for
// Vulkan waits for no more than one.
RenderDevice *Accumulation::next_to_finish(Clock::time_point until) const {
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

void Accumulation::finish_slice(RenderDevice &device) {
    const auto [paths, seconds] = device.finish();
    ++work_.submit_count;
    work_.seconds += seconds;
    pixels_done_ += paths;
    if (progress_.function && !stopped_)
        stopped_ = progress_.function(progress_.user, fraction()) != 0;
}

} // namespace pt
