// Takes an image's samples: in steps, between which it attends to progress, previews, checkpoints and the time limit;
// and in pieces of rows, if the device lacks memory for the whole image. The split does not change the image's bits.
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

// Between steps the device idles, and long steps divide best. So a step has at least the first one's samples, and aims
// at this duration.
inline constexpr std::uint32_t first_step_length = 16;
inline constexpr double step_seconds = 2.0;

// Length of the next step after one of this length and duration. The first step also builds the kernel, so it suggests
// too few samples rather than too many.
inline std::uint32_t next_step_length(std::uint32_t length, double seconds) {
    constexpr double most = 1U << 30; // if no time has passed by the clock
    const double wanted = seconds > 0.0 ? std::floor(length * (step_seconds / seconds)) : most;
    return static_cast<std::uint32_t>(std::clamp(wanted, double{first_step_length}, most));
}

// Whether to take no more samples, because of a signal or because they would not be used. Once true, it stays true.
using Stop = std::function<bool()>;

// Calls pt_set_render for the first piece, and returns the rows of a piece: as the options say, or all rows of the
// window, halved until the device has enough memory. Throws Failure.
std::uint32_t fit_pieces(const Context &context, const RenderTask &task);

// Progress on stderr, from the options and whether stderr is a terminal.
ProgressStyle progress_style(const RenderOptions &options);

class ImageRender {
public:
    // Writes a preview, in a thread of its own. After false (a file could not be written), only SIGUSR1 brings further
    // previews.
    using WritePreview = std::function<bool(const RenderedImage &)>;

    // rows: from fit_pieces(), already called. The task's time limit begins now.
    ImageRender(const Context &context, const RenderTask &task, std::uint32_t rows, Stop stop,
                WritePreview write_preview);

    struct Result {
        RenderedImage image;
        std::optional<std::string> ended_by; // see StoppingTest
        bool has_checkpoint;                 // the checkpoint has all samples
    };

    // The samples of a run; for a denoised picture, of one half in one or several rounds.
    struct Round {
        std::uint32_t half;                    // only the second one has layers, in its first round
        std::uint32_t end;                     // samples of the half at the end
        std::uint32_t other;                   // samples of the other half
        std::uint32_t expected;                // samples of a half, after all rounds
        std::vector<std::byte> *film{nullptr}; // film of the half: from earlier rounds, then with this one's samples
    };

    // Renders whole rows, as the library does, and reads the window's columns. The context's present samples are the
    // first ones of the first piece. Ends early once stop() is true. All writing has then ended. Throws Failure.
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
    WritePreview write_preview_; // empty for halves and frames: a frame's file means that the frame is done
    Clock::time_point start_ = Clock::now();
    Progress progress_;
    Round round_{};
    RenderedImage image_{};
    std::uint32_t piece_rows_ = 0; // of the present piece

    Clock::time_point next_error_; // next computation of the error, for progress
    StoppingTest stopping_;        // without rules for a half: rounds are tested with both halves
    Clock::time_point last_preview_ = start_;
    std::atomic<bool> has_preview_failed_ = false;
    RenderedImage preview_{}; // being written
    BackgroundTask preview_task_;
    std::optional<Checkpoint> checkpoint_;
};

} // namespace cli
