// Deals samples, and takes them in; see accumulation.h.
#include "lib/render/accumulation.h"

#include <algorithm>

namespace pt {

Accumulation::Accumulation(const Devices &devices, const SampleSet &samples, std::uint32_t first_sample,
                           std::uint32_t wanted, const Progress &progress, const Cancellation &cancellation,
                           DeviceWork &work) :
    SampleDealing(devices, {std::uint64_t{wanted} * devices.front()->pixel_count() - devices.front()->pass_pixels()},
                  progress, cancellation, work),
    first_sample_(first_sample),
    dealt_(samples) {
    if (const SampleRange pass = devices.front()->pass(); !pass.empty())
        dealt_.add(pass);
}

bool Accumulation::run(const Goal &goal, Clock::time_point until) {
    goal_ = goal;
    return go_on(until);
}

SampleSet Accumulation::samples() const {
    SampleSet whole = dealt_;
    if (const SampleRange pass = devices().front()->pass(); !pass.empty())
        whole.remove(pass);
    return whole;
}

void Accumulation::deal() {
    for (const auto &device : devices())
        while (deal_to(*device)) {
        }
}

// Starts a device's next slice, if it has room for one and there is one.
bool Accumulation::deal_to(RenderDevice &device) {
    const bool finishes_pass = !device.pass().empty() && !(stopped() && devices().size() == 1);
    const bool goes_on =
        !stopped() && (device.film_is_behind() || (device.pass().empty() && dealt_.count() < goal_.count));
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
    if (!goal_.unit_of_error || devices().size() > 1 || dealt_.count() + samples.count() < goal_.count)
        return std::nullopt;
    SampleSet all = dealt_;
    all.add(samples);
    return ErrorQuery{*goal_.unit_of_error, part_counts(all)};
}

} // namespace pt
