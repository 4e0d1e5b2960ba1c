// Takes the samples of an image: in steps, between which it attends to progress, previews, checkpoints and the time
// limit; and in pieces of rows, one after the other, if the device has not enough memory for the whole image. However
// they are split, the image has the same bits.
#pragma once

#include "cli/base/context.h"
#include "cli/base/progress.h"
#include "cli/base/tasks.h"
#include "cli/render/checkpoint.h"
#include "cli/render/picture_layer.h"
#include "cli/render/render_task.h"
#include "cli/render/stopping.h"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <cstdint>
#include <functional>
#include <optional>
#include <vector>

namespace cli {

// Between steps the device idles for a moment, and work can be divided best if a step has many samples. So a step has
// at least as many samples as the first one, and aims at this duration.
inline constexpr std::uint32_t first_step_length = 16;
inline constexpr double step_seconds = 2.0;

// The length of the step after one of this length and duration. The first step also builds the kernel, so its duration
// suggests too few samples rather than too many.
inline std::uint32_t next_step_length(std::uint32_t length, double seconds) {
    constexpr double most = 1U << 30; // if the clock saw no time pass
    const double wanted = seconds > 0.0 ? std::floor(length * (step_seconds / seconds)) : most;
    return static_cast<std::uint32_t>(std::clamp(wanted, double{first_step_length}, most));
}

// Returns true if no more samples should be taken, because a signal has come or they would not be used. Once true, it
// stays true.
using Stop = std::function<bool()>;

// Calls pt_set_render for the first piece, and returns how many rows a piece has: as many as the options say, or all
// rows of the window, halved until the device has enough memory. Throws Failure.
std::uint32_t fit_pieces(const Context &context, const RenderTask &task);

// The style of progress on stderr, from the options and whether stderr is a terminal.
ProgressStyle progress_style(const RenderOptions &options);

class ImageRender {
public:
    // Writes a preview, in a thread of its own. If it returns false, because a file could not be written, no more
    // previews are written unless SIGUSR1 asks.
    using WritePreview = std::function<bool(const RenderedImage &)>;

    // rows: of a piece, from fit_pieces(), which must have been called. The task's time limit begins now.
    ImageRender(const Context &context, const RenderTask &task, std::uint32_t rows, Stop stop,
                WritePreview write_preview);

    struct Result {
        RenderedImage image;
        std::optional<std::string> ended_by; // as of StoppingTest
        bool has_checkpoint;                 // the checkpoint has all samples
    };

    // The samples that a run takes: of a picture that is denoised, those of a half, in one or several rounds.
    struct Round {
        std::uint32_t half;                    // only the last one has layers, in its first round
        std::uint32_t end;                     // samples of the half at the end
        std::uint32_t other;                   // samples that the other half has
        std::uint32_t expected;                // of a half, after all rounds
        std::vector<std::byte> *film{nullptr}; // of the half: takes what earlier rounds left, leaves its own
    };

    // Renders whole rows, since the library renders nothing less, and reads the window's columns. Samples that the
    // context has already are the first ones of the first piece. Ends early, between or within pieces, once stop() is
    // true. Afterwards nothing is being written. Throws Failure.
    Result run(const Round &round);

private:
    using Clock = std::chrono::steady_clock;

    bool is_half() const { return task_.half_count() > 1; }
    bool has_target() const { return stopping_.rules().has_target(); }
    void enter_piece();
    void render_piece();
    pt_result take(std::uint32_t length, double done);
    bool has_ended(pt_result result, const pt_stats &done) const;
    pt_stats look(pt_result result);
    void show(const pt_stats &done, bool has_ended, const std::optional<pt_error_estimate> &error,
              Clock::time_point now);
    void preview(Clock::time_point now);
    bool stops() const { return stop_() || stopping_.is_over(); }
    bool wants_preview() const;
    bool pauses() const;

    const Context &context_;
    const RenderTask &task_;
    std::uint32_t rows_;
    Stop stop_;
    WritePreview write_preview_; // empty for halves, and for frames: a frame's file means that the frame is done
    Clock::time_point start_ = Clock::now();
    Progress progress_;
    Round round_{};
    RenderedImage image_{};
    std::uint32_t piece_rows_ = 0; // rows of the present piece

    Clock::time_point next_error_; // when the error is next computed for progress
    StoppingTest stopping_;        // without rules for a half, whose rounds are tested when both are there
    Clock::time_point last_preview_ = start_;
    std::atomic<bool> has_preview_failed_ = false;
    RenderedImage preview_{}; // the preview that is being written
    BackgroundTask preview_task_;
    std::optional<Checkpoint> checkpoint_;
};

} // namespace cli
