// What a rendering was asked to do beside its samples: checkpoints, previews, a limit of time.
#pragma once

#include "cli/base/context.h"
#include "cli/base/progress.h"
#include "cli/render/checkpoint_observer.h"
#include "cli/render/piecewise_render.h"
#include "cli/render/preview_observer.h"
#include "cli/render/render_options.h"
#include "cli/render/time_limit_observer.h"

#include <cstdint>
#include <functional>
#include <optional>
#include <vector>

namespace cli {

class PictureObservers {
public:
    // All must outlive it. The time that is limited begins now. write_preview: see PreviewObserver.
    PictureObservers(const Context &context, const RenderOptions &options, Progress &progress,
                     std::function<bool(const PiecewiseImage &)> write_preview);

    std::vector<PieceObserver *> list();

    // Once no more samples are taken: writes the last checkpoint, and waits for all that is being written.
    void finish(std::uint32_t sample_count);

    bool is_timed_out() const { return time_limit_ && time_limit_->has_come(); }
    bool has_checkpoint() const { return checkpoint_ && checkpoint_->is_valid(); }

private:
    std::optional<PreviewObserver> preview_; // of one picture: the file of a frame is to mean that it is done
    std::optional<CheckpointObserver> checkpoint_;
    std::optional<TimeLimitObserver> time_limit_;
};

} // namespace cli
