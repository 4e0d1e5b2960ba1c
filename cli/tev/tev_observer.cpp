#include "cli/tev/tev_observer.h"

#include <algorithm>
#include <utility>

namespace cli {
namespace {

constexpr std::chrono::seconds picture_interval{1};
// Reading the image so far, for which the device waits, takes this share of the time at the most.
constexpr int read_share = 100;

} // namespace

TevPicture tev_picture(const std::string &name, const ImageWindow &window, PiecewiseImage image) {
    return {name, window, image.rows_done, std::move(image.radiance), std::move(image.standard_error)};
}

TevObserver::TevObserver(const Context &context, TevViewer &viewer, std::string name, const ImageWindow &window,
                         std::function<void(const std::string &)> say) :
    context_(context),
    viewer_(viewer),
    name_(std::move(name)),
    window_(window),
    say_(std::move(say)),
    due_(Clock::now() + picture_interval) {}

void TevObserver::enter(const PiecewiseImage &before, std::uint32_t rows) {
    before_ = &before;
    rows_ = rows;
}

void TevObserver::stepped(const RenderState &state) {
    if (const std::string complaint = viewer_.take_complaint(); !complaint.empty()) {
        say_(complaint);
    }
    viewer_.look(state.time);
    if (!pauses() || state.sample_count == 0) {
        return;
    }
    const Clock::time_point begun = Clock::now();
    viewer_.show(tev_picture(name_, window_, image_so_far(context_, *before_, rows_)));
    const Clock::time_point now = Clock::now();
    due_ = now + std::max<Clock::duration>(picture_interval, read_share * (now - begun));
}

} // namespace cli
