// Renders an image in pieces of rows, one after the other, where a device has no memory for the whole. A sample does
// not depend on the piece in which it is taken: the image has the same bits.
#pragma once

#include "cli/base/context.h"
#include "cli/base/progress.h"
#include "cli/render/picture_layer.h"
#include "cli/render/render_observer.h"
#include "cli/render/render_task.h"

#include <cstdint>
#include <span>
#include <vector>

namespace cli {

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
