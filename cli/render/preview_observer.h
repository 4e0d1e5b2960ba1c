// Writes the picture so far, now and then or when SIGUSR1 asks for it, beside the rendering that goes on.
#pragma once

#include "cli/base/background_task.h"
#include "cli/base/context.h"
#include "cli/render/piecewise_render.h"

#include <atomic>
#include <chrono>
#include <functional>

namespace cli {

class PreviewObserver : public RenderObserver {
public:
    // seconds: between pictures; infinite: only those that are asked for. write: called in a thread of its own, no
    // longer than finish() waits; false if not all could be written, after which nothing is written by itself.
    PreviewObserver(const Context &context, double seconds, std::function<bool(const PiecewiseImage &)> write);

    void enter(const PiecewiseImage &before, std::uint32_t rows) override;
    bool pauses() const override { return is_wanted() && !task_.is_under_way(); }
    void stepped(const RenderState &state) override;

    // Waits for the picture that is being written.
    void finish() { task_.finish(); }

private:
    bool is_wanted() const;

    const Context &context_;
    std::chrono::duration<double> interval_;
    std::function<bool(const PiecewiseImage &)> write_;
    Clock::time_point last_;
    std::atomic<bool> has_failed_ = false;
    const PiecewiseImage *before_ = nullptr;
    std::uint32_t rows_ = 0; // of the piece
    PiecewiseImage image_{}; // of the task
    BackgroundTask task_;    // destroyed first: it uses the others
};

} // namespace cli
