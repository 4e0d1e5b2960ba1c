// Shows the picture so far in the image viewer tev, while it is rendered.
#pragma once

#include "cli/base/context.h"
#include "cli/render/piecewise_render.h"
#include "cli/tev/tev_viewer.h"

#include <chrono>
#include <functional>
#include <string>

namespace cli {

// What the viewer is shown of an image.
TevPicture tev_picture(const std::string &name, const ImageWindow &window, PiecewiseImage image);

class TevObserver : public PieceObserver {
public:
    using Clock = std::chrono::steady_clock;

    // name: of the picture in the viewer. say: shows a message.
    TevObserver(const Context &context, TevViewer &viewer, std::string name, const ImageWindow &window,
                std::function<void(const std::string &)> say);

    void enter(const PiecewiseImage &before, std::uint32_t rows) override;
    bool pauses() const override { return viewer_.is_idle() && Clock::now() >= due_; }
    void stepped(const RenderState &state) override;

private:
    const Context &context_;
    TevViewer &viewer_;
    std::string name_;
    ImageWindow window_;
    std::function<void(const std::string &)> say_;
    Clock::time_point due_;
    const PiecewiseImage *before_ = nullptr;
    std::uint32_t rows_ = 0; // of the piece
};

} // namespace cli
