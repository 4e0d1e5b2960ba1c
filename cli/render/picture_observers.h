// What a rendering was asked to do beside its samples: checkpoints, previews, a limit of time.
#pragma once

#include "cli/base/context.h"
#include "cli/base/progress.h"
#include "cli/render/checkpoint_observer.h"
#include "cli/render/piecewise_render.h"
#include "cli/render/preview_observer.h"
#include "cli/render/render_options.h"
#include "cli/render/time_limit_observer.h"
#include "cli/scene/render_settings.h"

#include <cstdint>
#include <functional>
#include <optional>
#include <vector>

namespace cli {

class PictureObservers {
public:
    // All must outlive it. The time that is limited begins now. write_preview: see PreviewObserver.
    PictureObservers(const Context &context, const RenderOptions &options, const RenderSettings &settings,
                     Progress &progress, std::function<bool(const PiecewiseImage &)> write_preview);

    std::vector<PieceObserver *> list();

    // Once no more samples are taken: writes the last checkpoint, and waits for all that is being written.
    void finish(std::uint32_t sample_count);

    bool is_timed_out() const { return time_limit_ && time_limit_->has_come(); }
    bool has_checkpoint() const { return checkpoint_ && checkpoint_->is_valid(); }

private:
    PreviewObserver preview_;
    std::optional<CheckpointObserver> checkpoint_;
    std::optional<TimeLimitObserver> time_limit_;
};

} // namespace cli
