#include "lib/render/accumulation.h"

#include <algorithm>
#include <numeric>
#include <thread>
#include <utility>

namespace pt {

Accumulation::Accumulation(const RenderDevices &devices, TileSamples samples, std::uint32_t first_sample,
                           std::uint64_t wanted, const Progress &progress, const Stopping &stopping,
                           const Cancellation &cancellation, DeviceWork &work) :
    devices_(devices),
    work_(work),
    progress_(progress),
    stopping_(stopping),
    cancellation_(cancellation),
    wanted_(std::max<std::uint64_t>(wanted, 1)),
    samples_(std::move(samples)),
    all_tiles_(samples_.grid().count()),
    first_sample_(first_sample) {
    std::iota(all_tiles_.begin(), all_tiles_.end(), 0U);
}

bool Accumulation::set_goal(std::span<const std::uint32_t> tiles, const TileTasks::Goal &goal) {
    return set(TileTasks(samples_, first_sample_, tiles, goal), std::nullopt);
}

bool Accumulation::set_goal_of_all(std::uint64_t goal, std::optional<double> unit_of_error) {
    return set(TileTasks(samples_.of(0), first_sample_, all_tiles_, goal), unit_of_error);
}

bool Accumulation::set(TileTasks tasks, std::optional<double> unit_of_error) {
    tasks_ = std::move(tasks);
    unit_of_error_ = unit_of_error;
    has_estimate_ = false;
    return !tasks_.empty();
}

// After `until`, collects finished slices but starts none. Otherwise short slices could keep the call from returning.
bool Accumulation::run(Clock::time_point until) {
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

void Accumulation::deal() {
    if (cancellation_.is_asked())
        stopped_ = PT_CANCELLED;
    else if (done_ > 0 && stopped_ == PT_OK && stopping_.spent() >= 1.0)
        stopped_ = PT_LIMIT_REACHED;
    if (begun_)
        start_begun();
    for (bool dealt = true; dealt;) {
        dealt = false;
        for (const auto &device : devices_)
            dealt |= deal_to(*device);
    }
}

bool Accumulation::deal_to(RenderDevice &device) {
    if (tasks_.empty() || (stopped_ != PT_OK && !tasks_.is_within_samples()) || !device.has_room())
        return false;
    const TileSlice slice = tasks_.next(device.schedule());
    if (!has_room_for(slice, device))
        return false;
    const bool is_last = tasks_.ends_all(slice.tiles.size());
    // The slice is stored before a device starts it, because started samples must be counted even after an exception.
    Begun next{slice, &device, samples_,
               is_last && unit_of_error_ && devices_.size() == 1 && device.estimates_behind()};
    next.samples.add(slice.tiles, slice.samples);
    if (tasks_.ends_samples(slice.tiles.size()))
        next.samples.tidy();
    begun_ = std::move(next);
    try {
        start_begun();
    } catch (...) {
        if (!begun_->is_partly_started)
            begun_.reset();
        throw;
    }
    return true;
}

bool Accumulation::has_room_for(const TileSlice &slice, const RenderDevice &taker) const {
    return taker.has_room() && (!slice.moves_split() ||
                                std::ranges::all_of(devices_, [](const auto &device) { return device->has_room(); }));
}

// One device takes the samples of the slice. The other devices only move sums between the parts of their films, so that
// all films can be added part by part.
void Accumulation::start_begun() {
    const ErrorQuery estimate{unit_of_error_.value_or(1.0), begun_->samples};
    for (; begun_->next_device < devices_.size(); ++begun_->next_device) {
        RenderDevice &device = *devices_[begun_->next_device];
        TileSlice slice = begun_->slice;
        slice.takes = &device == begun_->taker;
        if (!slice.takes && !slice.moves_split())
            continue;
        device.start(slice, begun_->is_estimated ? &estimate : nullptr);
        begun_->is_partly_started = true;
    }
    samples_ = std::move(begun_->samples);
    has_estimate_ = begun_->is_estimated;
    tasks_.leave_behind(begun_->slice.tiles.size());
    begun_.reset();
}

bool Accumulation::is_under_way() const {
    return std::ranges::any_of(devices_, [](const auto &device) { return !device->is_idle(); });
}

bool Accumulation::complete() noexcept {
    stopped_ = PT_CANCELLED;
    try {
        return run(Clock::time_point::max());
    } catch (...) {
        for (const auto &device : devices_)
            device->drain();
        return false;
    }
}

double Accumulation::fraction() const {
    return std::min(static_cast<double>(done_) / static_cast<double>(wanted_), 1.0);
}

// Returns NULL at `until`. Vulkan can wait for only one device, so several devices are polled.
RenderDevice *Accumulation::next_to_finish(Clock::time_point until) const {
    constexpr std::chrono::microseconds pause{50};
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
    const auto [tile_samples, seconds] = device.finish();
    ++work_.submit_count;
    work_.seconds += seconds;
    done_ += tile_samples;
    if (progress_.function && stopped_ == PT_OK && progress_.function(progress_.user, fraction()) != 0)
        stopped_ = PT_CANCELLED;
}

} // namespace pt
