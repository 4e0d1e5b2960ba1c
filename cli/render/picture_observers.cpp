#include "cli/render/picture_observers.h"

#include <limits>

namespace cli {

PictureObservers::PictureObservers(const Context &context, const RenderOptions &options, Progress &progress,
                                   std::function<bool(const PiecewiseImage &)> write_preview) {
    const auto say = [&progress](const std::string &message) { progress.say(message); };
    if (!options.frames) {
        preview_.emplace(context, options.preview_seconds.value_or(std::numeric_limits<double>::infinity()),
                         std::move(write_preview));
    }
    if (!options.checkpoint.empty()) {
        checkpoint_.emplace(context, options.checkpoint,
                            options.checkpoint_seconds.value_or(default_checkpoint_seconds), say);
    }
    if (options.time_limit) {
        time_limit_.emplace(TimeLimitObserver::Clock::now(), *options.time_limit);
        progress.limit_time(*options.time_limit);
    }
}

std::vector<PieceObserver *> PictureObservers::list() {
    std::vector<PieceObserver *> all;
    if (preview_)
        all.push_back(&*preview_);
    if (checkpoint_)
        all.push_back(&*checkpoint_);
    if (time_limit_)
        all.push_back(&*time_limit_);
    return all;
}

void PictureObservers::finish(std::uint32_t sample_count) {
    if (preview_)
        preview_->finish();
    if (checkpoint_)
        checkpoint_->finish(sample_count);
}

} // namespace cli
