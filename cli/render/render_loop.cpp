#include "cli/render/render_loop.h"

#include "cli/render/step_length.h"
#include "cli/scene/scene_setup.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <optional>

namespace cli {
namespace {

using Clock = std::chrono::steady_clock;
using Observers = std::span<RenderObserver *const>;

bool any_stops(Observers observers) {
    return std::any_of(observers.begin(), observers.end(), [](const RenderObserver *each) { return each->stops(); });
}

bool any_pauses(Observers observers) {
    return std::any_of(observers.begin(), observers.end(), [](const RenderObserver *each) { return each->pauses(); });
}

bool any_needs_error(Observers observers) {
    return std::any_of(observers.begin(), observers.end(),
                       [](const RenderObserver *each) { return each->needs_error(); });
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
        return any_stops(step->observers) || (has_sample && any_pauses(step->observers)) ? 1 : 0;
    }
};

pt_result take(const Context &context, const SceneFile &file, const RenderSettings &settings, Step &step) {
    pt_accumulate_info info{};
    info.struct_size = sizeof(pt_accumulate_info);
    info.sample_count = step.length;
    info.target_error = settings.target_error;
    info.sampling = settings.sampling;
    info.progress = &Step::receive;
    info.progress_user = &step;
    const pt_result result = pt_accumulate(context.get(), &info);
    require_render(context, file, settings, result);
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
Done done_of(const Context &context, const RenderSettings &settings) {
    if (settings.target_error > 0.0)
        return done_of(context.read_stats());
    const std::uint32_t count = context.sample_count();
    return {static_cast<double>(count), count, count};
}

// Whether all is done after a call that was not stopped.
bool has_ended(pt_result result, const Done &done, const RenderSettings &settings) {
    return result == PT_TARGET_REACHED || (result == PT_OK && done.most >= settings.sample_count);
}

Done tell(const Context &context, const RenderSettings &settings, Observers observers, pt_result result) {
    std::optional<pt_stats> stats;
    const Clock::time_point start = Clock::now();
    if (any_needs_error(observers))
        stats = context.read_stats();
    const Clock::time_point now = Clock::now();
    const Done done = stats ? done_of(*stats) : done_of(context, settings);
    for (RenderObserver *observer : observers) {
        observer->stepped({static_cast<std::uint32_t>(std::lround(done.mean)), now, has_ended(result, done, settings),
                           stats ? &*stats : nullptr, seconds_between(start, now)});
    }
    return done;
}

} // namespace

void run_render_loop(const Context &context, const SceneFile &file, const RenderSettings &settings,
                     Observers observers) {
    Done done = done_of(context, settings);
    Step step{observers, done.mean, 0};
    std::uint32_t wanted = first_step_length;
    bool ended = done.least >= settings.sample_count;
    while (!ended && !any_stops(observers)) {
        step.length = std::min(wanted, settings.sample_count - done.most);
        for (const RenderObserver *observer : observers)
            step.length = std::min(step.length, observer->next_end(done.most) - done.most);
        const Clock::time_point start = Clock::now();
        const pt_result result = take(context, file, settings, step);
        const double seconds = seconds_between(start, Clock::now());
        const std::uint32_t before = done.most;
        done = tell(context, settings, observers, result);
        step.before = done.mean;
        if (done.most > before) // else it was ended within a sample, and says nothing
            wanted = next_step_length(done.most - before, seconds);
        ended = has_ended(result, done, settings);
    }
}

} // namespace cli
