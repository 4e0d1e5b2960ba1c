#include "lib/render/tile_tasks.h"

#include <algorithm>

namespace pt {

// Tasks with fewer samples come first, because they have more tiles and keep a device busiest.
TileTasks::TileTasks(const TileSamples &present, std::uint32_t first_sample, std::span<const std::uint32_t> tiles,
                     const Goal &goal) {
    for (const std::uint32_t tile : tiles) {
        const std::uint64_t wanted = goal(tile);
        if (wanted <= present.of(tile).count())
            continue;
        const std::uint32_t set = present.set_of(tile);
        const auto same =
            std::ranges::find_if(tasks_, [&](const Task &task) { return task.set == set && task.wanted == wanted; });
        Task &task = same != tasks_.end() ? *same : add_task(set, wanted, present.of(tile), first_sample);
        task.found.push_back(tile);
    }
    for (Task &task : tasks_)
        task.tiles = task.found;
    std::ranges::stable_sort(tasks_, std::ranges::greater(), [](const Task &task) { return task.samples.count(); });
}

TileTasks::TileTasks(const SampleSet &present, std::uint32_t first_sample, std::span<const std::uint32_t> all_tiles,
                     std::uint64_t goal) {
    if (goal > present.count())
        add_task(0, goal, present, first_sample).tiles = all_tiles;
}

TileTasks::Task &TileTasks::add_task(std::uint32_t set, std::uint64_t wanted, const SampleSet &present,
                                     std::uint32_t first_sample) {
    SampleRange samples = present.next_missing(first_sample);
    samples.end = std::min(samples.end, samples.first + (wanted - present.count()));
    return tasks_.emplace_back(Task{set, wanted, present.hull(), samples});
}

TileSlice TileTasks::next(const Schedule &schedule) {
    Task &task = tasks_.back();
    if (!is_within_samples())
        task.chunk = {task.samples.first,
                      task.samples.first + schedule.samples(task.tiles.size(), task.samples.count())};
    const std::span<const std::uint32_t> left = task.tiles.subspan(task.next_tile);
    return {left.first(schedule.tiles(left.size(), task.chunk.count())), task.before, task.chunk, true};
}

bool TileTasks::ends_samples(std::size_t tile_count) const {
    return tasks_.back().next_tile + tile_count == tasks_.back().tiles.size();
}

bool TileTasks::ends_all(std::size_t tile_count) const {
    return tasks_.size() == 1 && ends_samples(tile_count) && tasks_.back().chunk.end == tasks_.back().samples.end;
}

void TileTasks::leave_behind(std::size_t tile_count) noexcept {
    Task &task = tasks_.back();
    task.next_tile += tile_count;
    if (task.next_tile < task.tiles.size())
        return;
    task.before = hull_of(task.before, task.chunk);
    task.samples.first = task.chunk.end;
    task.next_tile = 0;
    if (task.samples.empty())
        tasks_.pop_back();
}

} // namespace pt
