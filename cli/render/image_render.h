// Takes the samples of an image: in steps, between which it looks at what there is (for the progress that is shown,
// previews, checkpoints, and the limit of its time), and in pieces of rows, one after the other, where a device has no
// memory for the whole. However they are split, the image has the same bits.
#pragma once

#include "cli/base/context.h"
#include "cli/base/progress.h"
#include "cli/base/tasks.h"
#include "cli/render/checkpoint.h"
#include "cli/render/picture_layer.h"
#include "cli/render/render_task.h"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <cstdint>
#include <functional>
#include <optional>
#include <vector>

namespace cli {

// Between steps the device idles for a moment, and its work is divided best if there are many samples to choose from.
// So a step has at least as many samples as the first one, and aims at this duration.
inline constexpr std::uint32_t first_step_length = 16;
inline constexpr double step_seconds = 2.0;

// The length of the step that follows one of this length and duration. The first step also builds the kernel, so it
// suggests too few samples, not too many.
inline std::uint32_t next_step_length(std::uint32_t length, double seconds) {
    constexpr double most = 1U << 30; // where the clock saw no time pass
    const double wanted = seconds > 0.0 ? std::floor(length * (step_seconds / seconds)) : most;
    return static_cast<std::uint32_t>(std::clamp(wanted, double{first_step_length}, most));
}

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

// Returns true if no more samples should be taken, because a signal has come or nothing would become of them. Once
// true, it stays true.
using Stop = std::function<bool()>;

// Hands the render settings over for the first piece, and returns how many rows a piece has: as many as the options say
// or all of the window's, halved until the device has the memory. Throws Failure.
std::uint32_t fit_pieces(const Context &context, const RenderTask &task);

// On stderr, by the options and whether it is a terminal.
ProgressStyle progress_style(const RenderOptions &options);

class ImageRender {
public:
    // Writes a picture, in a thread of its own; false if not all could be written, after which none is written unless
    // SIGUSR1 asks.
    using WritePreview = std::function<bool(const RenderedImage &)>;

    // After fit_pieces, which says how many rows a piece has. The time of the task begins now.
    ImageRender(const Context &context, const RenderTask &task, std::uint32_t rows, Stop stop,
                WritePreview write_preview);

    struct Result {
        RenderedImage image;
        bool timed_out;      // whether some piece has fewer samples than without a limit of time
        bool has_checkpoint; // with all the samples
    };

    // Once. Renders whole rows, for rows are what the library can be asked for, and reads the window's columns. Ends
    // early, between or within pieces, once it is to stop. The samples that the context has are the first ones of the
    // first piece. Afterwards nothing is being written. Throws Failure.
    Result run();

private:
    using Clock = std::chrono::steady_clock;

    bool has_target() const { return task_.has_target(); }
    void enter_piece();
    void render_piece();
    pt_result take(std::uint32_t length, double done);
    bool has_ended(pt_result result, const pt_stats &done) const;
    pt_stats look(pt_result result);
    void show(const pt_stats &done, bool has_ended, const std::optional<pt_error_estimate> &error,
              Clock::time_point now);
    void preview(Clock::time_point now);
    bool stops() const { return stop_() || is_time_over_; }
    bool wants_preview() const;
    bool pauses() const;

    const Context &context_;
    const RenderTask &task_;
    std::uint32_t rows_;
    Stop stop_;
    WritePreview write_preview_; // empty for frames: the file of one is to mean that it is done
    Clock::time_point start_ = Clock::now();
    Progress progress_;
    RenderedImage image_{};
    std::uint32_t piece_rows_ = 0; // of the present piece

    Clock::time_point next_error_; // when the error is to be looked at for being shown
    Clock::time_point time_end_ = Clock::time_point::max();
    bool is_time_over_ = false; // of the piece
    bool has_timed_out_ = false;
    Clock::time_point last_preview_ = start_;
    std::atomic<bool> has_preview_failed_ = false;
    RenderedImage preview_{}; // that is being written
    BackgroundTask preview_task_;
    std::optional<Checkpoint> checkpoint_;
};

} // namespace cli
