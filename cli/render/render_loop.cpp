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
    double before; // samples of a pixel, on the average
    std::uint32_t length;

    static std::int32_t receive(void *user, double fraction) {
        const auto *step = static_cast<const Step *>(user);
        for (RenderObserver *observer : step->observers) {
            observer->submitted(step->before + fraction * step->length, Clock::now());
        }
        const bool has_sample = fraction * step->length >= 1.0; // else there is nothing new to be seen
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
    double mean;        // of the pixels
    std::uint32_t most; // of a pixel
};

Done tell(const Context &context, Observers observers, bool target_reached) {
    std::optional<pt_stats> stats;
    const Clock::time_point start = Clock::now();
    if (any_needs_error(observers)) {
        stats = context.read_stats();
    }
    const Clock::time_point now = Clock::now();
    const std::uint32_t least = stats ? stats->sample_count : context.sample_count();
    const Done done{stats ? stats->mean_sample_count : least, stats ? stats->max_sample_count : least};
    for (RenderObserver *observer : observers) {
        observer->stepped({static_cast<std::uint32_t>(std::lround(done.mean)), now, target_reached,
                           stats ? &*stats : nullptr, seconds_between(start, now)});
    }
    return done;
}

} // namespace

void run_render_loop(const Context &context, const SceneFile &file, const RenderSettings &settings,
                     Observers observers) {
    Done done{static_cast<double>(context.sample_count()), context.sample_count()};
    if (settings.target_error > 0.0) {
        const pt_stats stats = context.read_stats();
        done = {stats.mean_sample_count, stats.max_sample_count};
    }
    Step step{observers, done.mean, 0};
    std::uint32_t wanted = first_step_length;
    while (done.most < settings.sample_count && !any_stops(observers)) {
        step.length = std::min(wanted, settings.sample_count - done.most);
        for (const RenderObserver *observer : observers) {
            step.length = std::min(step.length, observer->next_end(done.most) - done.most);
        }
        const Clock::time_point start = Clock::now();
        const pt_result result = take(context, file, settings, step);
        const double seconds = seconds_between(start, Clock::now());
        const std::uint32_t before = done.most;
        done = tell(context, observers, result == PT_TARGET_REACHED);
        step.before = done.mean;
        if (done.most > before) { // else it was ended within a sample, and says nothing
            wanted = next_step_length(done.most - before, seconds);
        }
        if (result == PT_TARGET_REACHED) {
            return;
        }
    }
}

} // namespace cli
