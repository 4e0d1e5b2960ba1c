#include "cli/render/render_loop.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <optional>

namespace cli {
namespace {

using Clock = std::chrono::steady_clock;
using Observers = std::span<RenderObserver *const>;

bool any(Observers observers, bool (RenderObserver::*says)() const) {
    return std::ranges::any_of(observers, [says](const RenderObserver *each) { return (each->*says)(); });
}

double seconds_between(Clock::time_point start, Clock::time_point end) {
    return std::chrono::duration<double>(end - start).count();
}

// What the library's progress callback needs.
struct Step {
    Observers observers;
    double before;        // samples of a pixel, on the average
    std::uint32_t length; // 0: those that pixels lack of the most that one has

    static std::int32_t receive(void *user, double fraction) {
        const auto *step = static_cast<const Step *>(user);
        const double taken = fraction * std::max(step->length, 1U);
        for (RenderObserver *observer : step->observers)
            observer->submitted(step->before + taken, Clock::now());
        const bool has_sample = taken >= 1.0; // else there is nothing new to be seen
        return any(step->observers, &RenderObserver::stops) ||
                       (has_sample && any(step->observers, &RenderObserver::pauses))
                   ? 1
                   : 0;
    }
};

pt_result take(const Context &context, const RenderTask &task, Step &step) {
    pt_accumulate_info info{};
    info.struct_size = sizeof(pt_accumulate_info);
    info.sample_count = step.length;
    info.target_error = task.options.target_error;
    info.sampling = task.options.sampling;
    info.progress = &Step::receive;
    info.progress_user = &step;
    const pt_result result = pt_accumulate(context.get(), &info);
    require(context, task, result);
    return result;
}

// Samples that are done.
struct Done {
    double mean;         // of the pixels
    std::uint32_t least; // of a pixel
    std::uint32_t most;
};

Done done_of(const pt_stats &stats) {
    return {stats.mean_sample_count, stats.sample_count, stats.max_sample_count};
}

// Where pixels may have different numbers of samples, those that have fewest may still lack some.
Done done_of(const Context &context, const RenderTask &task) {
    if (task.has_target())
        return done_of(context.read_stats());
    const std::uint32_t count = context.sample_count();
    return {static_cast<double>(count), count, count};
}

// Whether all is done after a call that was not stopped.
bool has_ended(pt_result result, const Done &done, const RenderTask &task) {
    return result == PT_TARGET_REACHED || (result == PT_OK && done.most >= task.sample_count);
}

Done tell(const Context &context, const RenderTask &task, Observers observers, pt_result result) {
    std::optional<pt_stats> stats;
    const Clock::time_point start = Clock::now();
    if (any(observers, &RenderObserver::needs_error))
        stats = context.read_stats();
    const Clock::time_point now = Clock::now();
    const Done done = stats ? done_of(*stats) : done_of(context, task);
    for (RenderObserver *observer : observers) {
        observer->stepped({static_cast<std::uint32_t>(std::lround(done.mean)), now, has_ended(result, done, task),
                           stats ? &*stats : nullptr, seconds_between(start, now)});
    }
    return done;
}

} // namespace

void run_render_loop(const Context &context, const RenderTask &task, Observers observers) {
    Done done = done_of(context, task);
    Step step{observers, done.mean, 0};
    std::uint32_t wanted = first_step_length;
    bool ended = done.least >= task.sample_count;
    while (!ended && !any(observers, &RenderObserver::stops)) {
        step.length = std::min(wanted, task.sample_count - done.most);
        for (const RenderObserver *observer : observers)
            step.length = std::min(step.length, observer->next_end(done.most) - done.most);
        const Clock::time_point start = Clock::now();
        const pt_result result = take(context, task, step);
        const double seconds = seconds_between(start, Clock::now());
        const std::uint32_t before = done.most;
        done = tell(context, task, observers, result);
        step.before = done.mean;
        if (done.most > before) // else it was ended within a sample, and says nothing
            wanted = next_step_length(done.most - before, seconds);
        ended = has_ended(result, done, task);
    }
}

} // namespace cli
