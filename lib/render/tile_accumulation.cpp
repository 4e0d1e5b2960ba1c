// Deals samples of tiles; see tile_accumulation.h.
#include "lib/render/tile_accumulation.h"

#include <algorithm>
#include <utility>

namespace pt {

TileAccumulation::TileAccumulation(const Devices &devices, const TileSamples &samples, std::uint32_t first_sample,
                                   const Amount &amount, const Progress &progress, const Cancellation &cancellation,
                                   DeviceWork &work) :
    SampleDealing(devices, amount, progress, cancellation, work),
    samples_(samples),
    first_sample_(first_sample) {}

// Tiles with fewer samples come first, since they are the most: a device is busiest with them.
bool TileAccumulation::set_goal(std::span<const std::uint32_t> tiles,
                                const std::function<std::uint64_t(std::uint32_t)> &goal) {
    tasks_.clear();
    for (const std::uint32_t tile : tiles) {
        const std::uint64_t wanted = goal(tile);
        if (wanted > samples_.of(tile).count())
            task_of(samples_.set_of(tile), wanted).tiles.push_back(tile);
    }
    std::ranges::stable_sort(tasks_, std::ranges::greater(), [](const Task &task) { return task.samples.count(); });
    return !tasks_.empty();
}

// There are a few dozen tasks at the most, and thousands of tiles.
TileAccumulation::Task &TileAccumulation::task_of(std::uint32_t set, std::uint64_t wanted) {
    const auto found =
        std::ranges::find_if(tasks_, [&](const Task &task) { return task.set == set && task.wanted == wanted; });
    if (found != tasks_.end())
        return *found;
    const SampleSet &present = samples_.sets()[set];
    Task &task = tasks_.emplace_back();
    task.set = set;
    task.wanted = wanted;
    task.before = present.empty() ? SampleRange{} : present.hull();
    task.samples = present.next_missing(first_sample_);
    task.samples.end = std::min({task.samples.end, task.samples.first + (wanted - present.count()),
                                 end_of_run(task.before, task.samples.first)});
    return task;
}

bool TileAccumulation::run(Clock::time_point until) {
    return go_on(until);
}

const TileSamples &TileAccumulation::tidy_samples() {
    samples_.tidy();
    return samples_;
}

void TileAccumulation::deal() {
    if (begun_)
        start_begun();
    for (bool dealt = true; dealt;) {
        dealt = false;
        for (const auto &device : devices())
            dealt |= deal_to(*device);
    }
}

// Starts the next slice: some tiles of the task under way, with some of its samples. What has been begun of a tile's
// samples is whole as soon as the slice is done.
bool TileAccumulation::deal_to(RenderDevice &device) {
    const auto has_room = [](const auto &each) { return each->has_room(); };
    if (stopped() || tasks_.empty() || !std::ranges::all_of(devices(), has_room))
        return false;
    Task &task = tasks_.back();
    if (task.chunk.empty())
        task.chunk = {task.samples.first,
                      task.samples.first + device.affordable_samples(task.tiles.size(), task.samples.count())};
    const std::span<const std::uint32_t> left = std::span(task.tiles).subspan(task.next_tile);
    const TileSlice slice{left.first(std::min(device.affordable_tiles(task.chunk.count()), left.size())), task.before,
                          task.chunk, true};
    Begun next{slice, &device, samples_}; // before anything is started: what is must be counted
    next.samples.add(slice.tiles, task.chunk);
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

// One device takes the samples of the slice. The others fold, so that the films of all have the same samples in each
// part, and add up part by part.
void TileAccumulation::start_begun() {
    for (; begun_->next_device < devices().size(); ++begun_->next_device) {
        RenderDevice &device = *devices()[begun_->next_device];
        TileSlice slice = begun_->slice;
        slice.takes = &device == begun_->taker;
        if (slice.takes || slice.moves_split()) {
            device.start_tiles(slice);
            begun_->is_partly_started = true;
        }
    }
    samples_ = std::move(begun_->samples);
    const std::size_t tile_count = begun_->slice.tiles.size();
    begun_.reset();
    leave_behind(tile_count);
}

// Goes to the tiles behind these, or to the next samples of all.
void TileAccumulation::leave_behind(std::size_t tile_count) {
    Task &task = tasks_.back();
    task.next_tile += tile_count;
    if (task.next_tile < task.tiles.size())
        return;
    task.before = task.before.empty() ? task.chunk : hull_of(task.before, task.chunk);
    task.samples.first = task.chunk.end;
    task.chunk = {};
    task.next_tile = 0;
    if (task.samples.empty())
        tasks_.pop_back();
}

} // namespace pt
