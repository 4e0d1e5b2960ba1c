// Takes an image's samples in steps. Progress, previews and checkpoints come between steps. If the device lacks memory,
// it renders pieces of rows. Neither steps nor pieces change the bits.
#pragma once

#include "cli/base/context.h"
#include "cli/base/progress.h"
#include "cli/base/tasks.h"
#include "cli/picture/picture_layer.h"
#include "cli/render/checkpoint.h"
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

// Long steps are best for several devices.
inline constexpr std::uint32_t first_step_length = 16;
inline constexpr double step_seconds = 2.0;

// The first step also builds the kernel, so the second may be too short.
inline std::uint32_t next_step_length(std::uint32_t length, double seconds) {
    constexpr double most = 1U << 30;
    const double wanted = seconds > 0.0 ? std::floor(length * (step_seconds / seconds)) : most;
    return static_cast<std::uint32_t>(std::clamp(wanted, double{first_step_length}, most));
}

// Whether a signal or a changed source ends the rendering. Once true, it stays true.
using Stop = std::function<bool()>;

// Calls pt_set_render for the first piece. Returns the number of rows of a piece: the option's, or all rows, halved
// until they fit into the device's memory. Throws Failure.
std::uint32_t fit_pieces(const Context &context, const RenderTask &task);

ProgressStyle progress_style(const RenderOptions &options);

class ImageRender {
public:
    // Runs in a thread. After it returns false, only SIGUSR1 requests previews.
    using WritePreview = std::function<bool(const RenderedImage &)>;

    // `rows` is the result of fit_pieces(). The time limit begins now.
    ImageRender(const Context &context, const RenderTask &task, std::uint32_t rows, Stop stop,
                WritePreview write_preview);

    struct Result {
        RenderedImage image;
        std::optional<std::string> ended_by;
        bool has_checkpoint;
    };

    // A whole picture, or one round of one half of a denoised picture.
    struct Round {
        std::uint32_t half;                    // 0 or 1
        std::uint32_t end;                     // samples of this half at the end of the round
        std::uint32_t other;                   // samples of the other half
        std::uint32_t expected;                // samples of a half after all rounds
        std::vector<std::byte> *film{nullptr}; // film of the half, read before the round and updated after it
    };

    // Renders whole rows and reads the window's columns. The samples of the context belong to the first piece. On
    // return all files are complete. Throws Failure.
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
    WritePreview write_preview_; // empty for halves, and for frames, whose existing files must be complete
    Clock::time_point start_ = Clock::now();
    Progress progress_;
    Round round_{};
    RenderedImage image_{};
    std::uint32_t piece_rows_ = 0;

    Clock::time_point next_error_;
    StoppingTest stopping_; // has no rules for a half
    Clock::time_point last_preview_ = start_;
    std::atomic<bool> has_preview_failed_ = false;
    RenderedImage preview_{};
    BackgroundTask preview_task_;
    std::optional<Checkpoint> checkpoint_;
};

} // namespace cli
