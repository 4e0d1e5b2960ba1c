// Takes the samples of an image: in steps, between which observers look at what there is, and in pieces of rows, one
// after the other, where a device has no memory for the whole. However they are split, the image has the same bits.
#pragma once

#include "cli/base/context.h"
#include "cli/base/progress.h"
#include "cli/render/picture_layer.h"
#include "cli/render/render_observer.h"
#include "cli/render/render_task.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <span>
#include <vector>

namespace cli {

// The device idles for a moment between steps, and its work is cut best where it has samples to choose from. So a step
// has no fewer than the first one, and takes about so long.
inline constexpr std::uint32_t first_step_length = 16;
inline constexpr double step_seconds = 2.0;

// After a step of so many samples that took so long. The first one builds the kernel: it says too little, not too much.
inline std::uint32_t next_step_length(std::uint32_t length, double seconds) {
    constexpr double most = 1U << 30; // where the clock saw no time pass
    const double wanted = seconds > 0.0 ? std::floor(length * (step_seconds / seconds)) : most;
    return static_cast<std::uint32_t>(std::clamp(wanted, double{first_step_length}, most));
}

// From the samples that the context has on, until there are enough, the target error is reached or an observer stops
// it. The target error is looked at by the library, at counts that do not depend on the steps. Throws Failure.
void run_render_loop(const Context &context, const RenderTask &task, std::span<RenderObserver *const> observers);

struct PiecewiseImage {
    Rectangle part;                    // of the picture: the task's window
    std::vector<float> radiance;       // of this part; black below rows_done
    std::vector<float> standard_error; // empty if it was not asked for
    std::vector<PictureLayer> layers;  // likewise
    std::uint32_t rows_done;           // of it, with samples
    pt_stats stats;                    // of these rows; sample_count is the least of the pieces
};

// Hands the render settings over for the first piece, and returns how many rows a piece has: as many as the options say
// or all of the window's, halved until the device has the memory. Throws Failure.
std::uint32_t fit_pieces(const Context &context, const RenderTask &task);

// The image so far, with what the context has of a piece.
PiecewiseImage image_so_far(const Context &context, const PiecewiseImage &before, std::uint32_t rows);

// After fit_pieces. Renders whole rows, for rows are what the library can be asked for, and reads the window's columns.
// Ends early, between or within pieces, once it is to stop. The samples that the context has are the first ones of the
// first piece.
PiecewiseImage render_pieces(const Context &context, const RenderTask &task, std::uint32_t rows, const Stop &stop,
                             Progress &progress, std::span<RenderObserver *const> others);

} // namespace cli
