// Ends a rendering after some time, with one sample at the least: a picture without samples would be none.
#pragma once

#include "cli/render/piecewise_render.h"

#include <chrono>

namespace cli {

class TimeLimitObserver : public RenderObserver {
public:
    TimeLimitObserver(Clock::time_point start, double seconds) : start_(start), seconds_(seconds) {}

    // Each piece of the image has its share of the time, with what those before have left.
    void enter(const PiecewiseImage &before, std::uint32_t rows) override {
        const double share = (static_cast<double>(before.rows_done) + rows) / before.part.height;
        const std::chrono::duration<double> time(seconds_ * share);
        end_ = start_ + std::chrono::duration_cast<Clock::duration>(time);
        is_over_ = false;
    }

    bool pauses() const override { return Clock::now() >= end_; }

    void stepped(const RenderState &state) override {
        is_over_ = !state.has_ended && state.sample_count > 0 && state.time >= end_;
        has_ended_piece_ = has_ended_piece_ || is_over_;
    }

    bool stops() const override { return is_over_; }

    // Whether some piece has fewer samples than without a limit.
    bool has_come() const { return has_ended_piece_; }

private:
    Clock::time_point start_;
    double seconds_;
    Clock::time_point end_;
    bool is_over_ = false;
    bool has_ended_piece_ = false;
};

} // namespace cli
