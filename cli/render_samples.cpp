// Owns the taking of samples by `pt render`: until there are enough, the target error is reached or a signal comes.
// Called by render_command.
#include "render_samples.h"

#include "interrupt.h"
#include "sample_forecast.h"

#include <algorithm>

namespace cli {
namespace {

// What the library's progress callback needs, and the samples before and in the present call.
struct Watch {
    Progress &progress;
    const ImageWriter &writer;
    std::uint32_t before;
    std::uint32_t within;

    bool stopped() const { return interrupt_signal() != 0 || writer.failed(); }

    static std::int32_t receive(void *user, double fraction) {
        const auto *watch = static_cast<Watch *>(user);
        watch->progress.update_samples(watch->before + fraction * watch->within, Progress::Clock::now());
        return watch->stopped() ? 1 : 0;
    }
};

pt_result accumulate(const Context &context, Watch &watch, double target_error) {
    pt_accumulate_info info{};
    info.struct_size = sizeof(pt_accumulate_info);
    info.sample_count = watch.within;
    info.target_error = target_error;
    info.progress = &Watch::receive;
    info.progress_user = &watch;
    const pt_result result = pt_accumulate(context.get(), &info);
    context.require(result);
    return result;
}

// From one look at the error to the next, each of which tells better how far it is to the target.
void reach_target(const Context &context, const RenderSettings &settings, Watch &watch) {
    double error = settings.target_error; // as if reached, so that the first look is the first goal
    while (watch.before < settings.sample_count) {
        watch.within = std::min(samples_to_next_look(watch.before), settings.sample_count - watch.before);
        watch.progress.expect(forecast_sample_count(watch.before, error, settings.target_error, settings.sample_count));
        const pt_result result = accumulate(context, watch, settings.target_error);
        const pt_stats stats = context.read_stats();
        watch.before = stats.sample_count;
        error = stats.relative_rmse_high;
        if (result == PT_TARGET_REACHED) {
            watch.progress.expect(watch.before);
            watch.progress.update_samples(watch.before, Progress::Clock::now());
        }
        if (result != PT_OK || watch.stopped()) {
            return;
        }
    }
}

} // namespace

void take_samples(const Context &context, const RenderSettings &settings, const ImageWriter &writer,
                  Progress &progress) {
    Watch watch{progress, writer, 0, settings.sample_count};
    if (watch.stopped()) {
        return;
    }
    if (settings.target_error > 0.0) {
        reach_target(context, settings, watch);
    } else {
        accumulate(context, watch, 0.0);
    }
}

} // namespace cli
