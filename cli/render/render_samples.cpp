// Owns the taking of samples by `pt render`: until there are enough, the target error is reached or they are to stop.
// Called by piecewise_render.
#include "cli/render/render_samples.h"

#include "cli/render/sample_forecast.h"
#include "cli/scene/scene_setup.h"

#include <algorithm>

namespace cli {
namespace {

// What the library's progress callback needs, and the samples before and in the present call.
struct Watch {
    Progress &progress;
    const Stop &stop;
    const SceneFile &file;
    std::uint32_t before;
    std::uint32_t within;

    static std::int32_t receive(void *user, double fraction) {
        const auto *watch = static_cast<Watch *>(user);
        watch->progress.update_samples(watch->before + fraction * watch->within, Progress::Clock::now());
        return watch->stop() ? 1 : 0;
    }
};

pt_result accumulate(const Context &context, const RenderSettings &settings, Watch &watch) {
    pt_accumulate_info info{};
    info.struct_size = sizeof(pt_accumulate_info);
    info.sample_count = watch.within;
    info.target_error = settings.target_error;
    info.progress = &Watch::receive;
    info.progress_user = &watch;
    const pt_result result = pt_accumulate(context.get(), &info);
    require_samples(context, watch.file, settings, result);
    return result;
}

// From one look at the error to the next, each of which tells better how far it is to the target.
void reach_target(const Context &context, const RenderSettings &settings, Watch &watch) {
    double error = settings.target_error; // as if reached, so that the first look is the first goal
    while (watch.before < settings.sample_count) {
        watch.within = std::min(samples_to_next_look(watch.before), settings.sample_count - watch.before);
        watch.progress.expect(forecast_sample_count(watch.before, error, settings.target_error, settings.sample_count));
        const pt_result result = accumulate(context, settings, watch);
        const pt_stats stats = context.read_stats();
        watch.before = stats.sample_count;
        error = stats.relative_rmse_high;
        if (result == PT_TARGET_REACHED) {
            watch.progress.expect(watch.before);
            watch.progress.update_samples(watch.before, Progress::Clock::now());
        }
        if (result != PT_OK || watch.stop()) {
            return;
        }
    }
}

} // namespace

void take_samples(const Context &context, const SceneFile &file, const RenderSettings &settings, const Stop &stop,
                  Progress &progress) {
    Watch watch{progress, stop, file, 0, settings.sample_count};
    if (stop()) {
        return;
    }
    if (settings.target_error > 0.0) {
        reach_target(context, settings, watch);
    } else {
        accumulate(context, settings, watch);
    }
}

} // namespace cli
