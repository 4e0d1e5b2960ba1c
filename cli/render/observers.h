// What looks at a rendering: the progress that is shown, previews, and the limit of its time.
#pragma once

#include "cli/base/context.h"
#include "cli/base/progress.h"
#include "cli/base/tasks.h"
#include "cli/render/piecewise_render.h"
#include "cli/render/render_observer.h"

#include <pt/stats.h>

#include <algorithm>
#include <atomic>
#include <bit>
#include <chrono>
#include <cmath>
#include <cstdint>
#include <functional>

namespace cli {

// How many samples a target error takes in all, where `sample_count` samples have the error `error`, which may be
// infinite. Of independent samples, the error falls with the root of their number: stratified samples need fewer, and
// the guess falls as they come. More than the samples done at the next look, so that no share of it is 1 before the
// target is reached.
inline std::uint32_t forecast_sample_count(std::uint32_t sample_count, double error, double target_error,
                                           std::uint32_t most) {
    const double ratio = error / target_error;
    const double guess = sample_count * ratio * ratio;
    const double least = pt_next_check(sample_count) + 1.0;
    return static_cast<std::uint32_t>(std::min(std::max(std::ceil(guess), least), static_cast<double>(most)));
}

class ProgressObserver : public RenderObserver {
public:
    // target_error: 0 for none. With one, the number of samples is a guess, which is mended at each check of the error.
    // sample_count: those that are there already.
    ProgressObserver(Progress &progress, double target_error, std::uint32_t sample_count, std::uint32_t most) :
        progress_(progress),
        target_error_(target_error),
        most_(most) {
        if (has_target()) // the next check
            progress_.expect(forecast_sample_count(sample_count, target_error_, target_error_, most_));
    }

    std::uint32_t next_end(std::uint32_t sample_count) const override {
        constexpr std::uint32_t first_end = 16; // where an error is known, and tiles take as many again from there on
        return has_target() ? std::max(first_end, 2 * std::bit_floor(sample_count))
                            : RenderObserver::next_end(sample_count);
    }

    // Where it is only shown, for a hundredth of the time.
    bool needs_error() const override {
        return has_target() || (progress_.shows_error() && Progress::Clock::now() >= next_look_);
    }

    void submitted(double sample_count, Progress::Clock::time_point time) override {
        progress_.update_samples(sample_count, time);
    }

    void stepped(const RenderState &state) override {
        if (state.stats != nullptr) {
            constexpr double share = 0.01;
            const std::chrono::duration<double> wait(state.stats_seconds / share);
            next_look_ = state.time + std::chrono::duration_cast<Progress::Clock::duration>(wait);
            progress_.show_error(state.stats->relative_rmse);
        }
        if (state.has_ended && state.sample_count < most_) {
            progress_.expect(state.sample_count);
            progress_.update_samples(state.sample_count, state.time);
        } else if (has_target() && state.sample_count < most_) {
            progress_.expect(
                forecast_sample_count(state.sample_count, state.stats->relative_rmse_high, target_error_, most_));
        }
    }

private:
    bool has_target() const { return target_error_ > 0.0; }

    Progress &progress_;
    double target_error_;
    std::uint32_t most_;
    Progress::Clock::time_point next_look_;
};

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
