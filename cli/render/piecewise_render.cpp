#include "cli/render/piecewise_render.h"

#include "cli/render/observers.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <optional>

namespace cli {
namespace {

using Clock = std::chrono::steady_clock;
using Observers = std::span<RenderObserver *const>;

bool any(Observers observers, bool (RenderObserver::*says)() const) {
    return std::ranges::any_of(observers, [says](const RenderObserver *each) { return (each->*says)(); });
}

double seconds_between(Clock::time_point start, Clock::time_point end) {
    return std::chrono::duration<double>(end - start).count();
}

// What the library's progress callback needs.
struct Step {
    Observers observers;
    double before;        // samples of a pixel, on the average
    std::uint32_t length; // 0: those that pixels lack of the most that one has

    static std::int32_t receive(void *user, double fraction) {
        const auto *step = static_cast<const Step *>(user);
        const double taken = fraction * std::max(step->length, 1U);
        for (RenderObserver *observer : step->observers)
            observer->submitted(step->before + taken, Clock::now());
        const bool has_sample = taken >= 1.0; // else there is nothing new to be seen
        return any(step->observers, &RenderObserver::stops) ||
                       (has_sample && any(step->observers, &RenderObserver::pauses))
                   ? 1
                   : 0;
    }
};

pt_result take(const Context &context, const RenderTask &task, Step &step) {
    auto info = sized<pt_accumulate_info>();
    info.sample_count = step.length;
    info.target_error = task.options.target_error;
    info.sampling = task.options.sampling;
    info.progress = &Step::receive;
    info.progress_user = &step;
    const pt_result result = pt_accumulate(context.get(), &info);
    require(context, task, result);
    return result;
}

// Samples that are done.
struct Done {
    double mean;         // of the pixels
    std::uint32_t least; // of a pixel
    std::uint32_t most;
};

Done done_of(const pt_stats &stats) {
    return {stats.mean_sample_count, stats.sample_count, stats.max_sample_count};
}

// Where pixels may have different numbers of samples, those that have fewest may still lack some.
Done done_of(const Context &context, const RenderTask &task) {
    if (task.has_target())
        return done_of(context.read_stats());
    const std::uint32_t count = context.sample_count();
    return {static_cast<double>(count), count, count};
}

// Whether all is done after a call that was not stopped.
bool has_ended(pt_result result, const Done &done, const RenderTask &task) {
    return result == PT_TARGET_REACHED || (result == PT_OK && done.most >= task.sample_count);
}

Done tell(const Context &context, const RenderTask &task, Observers observers, pt_result result) {
    std::optional<pt_stats> stats;
    const Clock::time_point start = Clock::now();
    if (any(observers, &RenderObserver::needs_error))
        stats = context.read_stats();
    const Clock::time_point now = Clock::now();
    const Done done = stats ? done_of(*stats) : done_of(context, task);
    for (RenderObserver *observer : observers) {
        observer->stepped({static_cast<std::uint32_t>(std::lround(done.mean)), now, has_ended(result, done, task),
                           stats ? &*stats : nullptr, seconds_between(start, now)});
    }
    return done;
}

// first_row: of the window.
pt_render piece_of(const RenderTask &task, std::uint32_t first_row, std::uint32_t rows) {
    const Rectangle &part = task.window.part;
    pt_render piece = task.render;
    piece.first_row = part.y + first_row;
    piece.row_count = std::min(rows, part.height - first_row);
    return piece;
}

// The root of the mean of squares over the image, from that over its parts: before of first_row rows, and of rows more.
double joined(double before, std::uint32_t first_row, double part, std::uint32_t rows) {
    const double sum = before * before * first_row + part * part * rows;
    return std::sqrt(sum / (static_cast<double>(first_row) + rows));
}

// Adds what is known of a piece. The bounds of several pieces are joined as if all erred to the same side.
void join(pt_stats &whole, const pt_stats &piece, std::uint32_t first_row, std::uint32_t rows) {
    if (first_row == 0) {
        whole = piece;
        return;
    }
    whole.sample_count = std::min(whole.sample_count, piece.sample_count);
    whole.max_sample_count = std::max(whole.max_sample_count, piece.max_sample_count);
    whole.mean_sample_count =
        (whole.mean_sample_count * first_row + piece.mean_sample_count * rows) / (first_row + rows);
    whole.rejected_samples += piece.rejected_samples;
    whole.device_bytes = std::max(whole.device_bytes, piece.device_bytes);
    whole.submit_count = piece.submit_count; // of the context
    whole.device_seconds = piece.device_seconds;
    whole.uncertain |= piece.uncertain;
    for (double pt_stats::*const error :
         {&pt_stats::rmse, &pt_stats::rmse_low, &pt_stats::rmse_high, &pt_stats::relative_rmse,
          &pt_stats::relative_rmse_low, &pt_stats::relative_rmse_high}) {
        whole.*error = joined(whole.*error, first_row, piece.*error, rows);
    }
}

void render_piece(const Context &context, const RenderTask &task, const Stop &stop, Progress &progress,
                  std::span<RenderObserver *const> others) {
    ProgressObserver progress_observer(progress, task.options.target_error, context.sample_count(), task.sample_count);
    StopObserver stop_observer(stop);
    std::vector<RenderObserver *> observers{&progress_observer, &stop_observer};
    observers.insert(observers.end(), others.begin(), others.end());
    run_render_loop(context, task, observers);
}

// Adds the samples that the context has of a piece; false if there are none.
bool add_piece(const Context &context, std::uint32_t rows, PiecewiseImage &image) {
    const pt_stats stats = context.read_stats();
    if (stats.sample_count == 0)
        return false;
    join(image.stats, stats, image.rows_done, rows);
    const auto read = [&](std::uint32_t quantity, std::vector<float> &values) {
        const std::size_t first = std::size_t{3} * image.part.width * image.rows_done;
        context.read_columns(image.part.x, image.part.width, rows, quantity, &values[first]);
    };
    read(PT_QUANTITY_RADIANCE, image.radiance);
    if (!image.standard_error.empty())
        read(PT_QUANTITY_STANDARD_ERROR, image.standard_error);
    for (PictureLayer &layer : image.layers)
        layer.read(context, image.part, image.rows_done, rows);
    image.rows_done += rows;
    return true;
}

} // namespace

void run_render_loop(const Context &context, const RenderTask &task, Observers observers) {
    Done done = done_of(context, task);
    Step step{observers, done.mean, 0};
    std::uint32_t wanted = first_step_length;
    bool ended = done.least >= task.sample_count;
    while (!ended && !any(observers, &RenderObserver::stops)) {
        step.length = std::min(wanted, task.sample_count - done.most);
        for (const RenderObserver *observer : observers)
            step.length = std::min(step.length, observer->next_end(done.most) - done.most);
        const Clock::time_point start = Clock::now();
        const pt_result result = take(context, task, step);
        const double seconds = seconds_between(start, Clock::now());
        const std::uint32_t before = done.most;
        done = tell(context, task, observers, result);
        step.before = done.mean;
        if (done.most > before) // else it was ended within a sample, and says nothing
            wanted = next_step_length(done.most - before, seconds);
        ended = has_ended(result, done, task);
    }
}

std::uint32_t fit_pieces(const Context &context, const RenderTask &task) {
    const std::uint32_t height = task.window.part.height;
    std::uint32_t rows = task.options.piece_rows == 0 ? height : std::min(task.options.piece_rows, height);
    for (;; rows = (rows + 1) / 2) {
        const pt_render piece = piece_of(task, 0, rows);
        const pt_result result = pt_set_render(context.get(), &piece);
        const bool too_large = result == PT_ERROR_UNSUPPORTED || result == PT_ERROR_OUT_OF_DEVICE_MEMORY;
        if (too_large && rows > 1)
            continue;
        require(context, task, result);
        return rows;
    }
}

PiecewiseImage image_so_far(const Context &context, const PiecewiseImage &before, std::uint32_t rows) {
    PiecewiseImage image = before;
    add_piece(context, rows, image);
    return image;
}

PiecewiseImage render_pieces(const Context &context, const RenderTask &task, std::uint32_t rows, const Stop &stop,
                             Progress &progress, std::span<RenderObserver *const> others) {
    const Rectangle &part = task.window.part;
    PiecewiseImage image{};
    image.part = part;
    image.radiance.resize(3 * part.pixel_count());
    image.standard_error.resize(task.options.output.standard_error.empty() ? 0 : image.radiance.size());
    for (const std::uint32_t layer : task.options.wanted_layers())
        image.layers.emplace_back(layer, part.pixel_count());
    while (image.rows_done < part.height && !stop()) {
        const std::uint32_t first_row = image.rows_done;
        const pt_render piece = piece_of(task, first_row, rows);
        if (first_row > 0)
            context.require(pt_set_render(context.get(), &piece));
        const double height = part.height;
        progress.enter_part(first_row / height, (first_row + piece.row_count) / height);
        for (RenderObserver *other : others)
            other->enter(image, piece.row_count);
        render_piece(context, task, stop, progress, others);
        if (!add_piece(context, piece.row_count, image))
            break;
    }
    if (image.rows_done == 0)
        image.stats = context.read_stats();
    return image;
}

} // namespace cli
