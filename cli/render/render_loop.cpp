#include "cli/render/render_loop.h"

#include "cli/render/step_length.h"
#include "cli/scene/scene_setup.h"

#include <algorithm>
#include <chrono>
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
    std::uint32_t before; // samples
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
    info.progress = &Step::receive;
    info.progress_user = &step;
    const pt_result result = pt_accumulate(context.get(), &info);
    require_render(context, file, settings, result);
    return result;
}

// Returns the samples that are done.
std::uint32_t tell(const Context &context, Observers observers, bool target_reached) {
    std::optional<pt_stats> stats;
    const Clock::time_point start = Clock::now();
    if (any_needs_error(observers)) {
        stats = context.read_stats();
    }
    const Clock::time_point now = Clock::now();
    const std::uint32_t sample_count = stats ? stats->sample_count : context.sample_count();
    for (RenderObserver *observer : observers) {
        observer->stepped({sample_count, now, target_reached, stats ? &*stats : nullptr, seconds_between(start, now)});
    }
    return sample_count;
}

} // namespace

void run_render_loop(const Context &context, const SceneFile &file, const RenderSettings &settings,
                     Observers observers) {
    Step step{observers, context.sample_count(), 0};
    std::uint32_t wanted = first_step_length;
    while (step.before < settings.sample_count && !any_stops(observers)) {
        step.length = std::min(wanted, settings.sample_count - step.before);
        for (const RenderObserver *observer : observers) {
            step.length = std::min(step.length, observer->next_end(step.before) - step.before);
        }
        const Clock::time_point start = Clock::now();
        const pt_result result = take(context, file, settings, step);
        const double seconds = seconds_between(start, Clock::now());
        const std::uint32_t before = step.before;
        step.before = tell(context, observers, result == PT_TARGET_REACHED);
        if (step.before > before) { // else it was ended within a sample, and says nothing
            wanted = next_step_length(step.before - before, seconds);
        }
        if (result == PT_TARGET_REACHED) {
            return;
        }
    }
}

} // namespace cli
