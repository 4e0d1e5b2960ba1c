#include "cli/render/observers.h"

#include "cli/base/interrupt.h"

namespace cli {

PreviewObserver::PreviewObserver(const Context &context, double seconds,
                                 std::function<bool(const PiecewiseImage &)> write) :
    context_(context),
    interval_(seconds),
    write_(std::move(write)),
    last_(Clock::now()) {}

void PreviewObserver::enter(const PiecewiseImage &before, std::uint32_t rows) {
    before_ = &before;
    rows_ = rows;
}

bool PreviewObserver::is_wanted() const {
    return has_picture_request() || (!has_failed_ && Clock::now() - last_ >= interval_);
}

void PreviewObserver::stepped(const RenderState &state) {
    if (!pauses() || state.sample_count == 0)
        return;
    forget_picture_request();
    last_ = state.time;
    task_.finish();
    image_ = image_so_far(context_, *before_, rows_);
    task_.start([this] { has_failed_ = !write_(image_); });
}

} // namespace cli
