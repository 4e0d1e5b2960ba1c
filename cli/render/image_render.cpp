#include "cli/render/image_render.h"

#include "cli/base/interrupt.h"
#include "cli/film/film.h"
#include "lib/platform/file.h"
#include "lib/platform/terminal.h"

#include <bit>
#include <chrono>
#include <iostream>
#include <limits>

namespace cli {
namespace {

double seconds_between(std::chrono::steady_clock::time_point start, std::chrono::steady_clock::time_point end) {
    return std::chrono::duration<double>(end - start).count();
}

std::chrono::steady_clock::duration clock_duration(double seconds) {
    return std::chrono::duration_cast<std::chrono::steady_clock::duration>(std::chrono::duration<double>(seconds));
}

pt_render piece_of(const RenderTask &task, std::uint32_t half, std::uint32_t first_row, std::uint32_t rows) {
    constexpr std::uint64_t other_seed = std::uint64_t{1} << 63; // as in the Python package
    const Rectangle &part = task.window.part;
    pt_render piece = task.render;
    piece.seed ^= half * other_seed;
    piece.first_row = part.y + first_row;
    piece.row_count = std::min(rows, part.height - first_row);
    return piece;
}

// Averages error bounds as if the errors were fully correlated.
void join(RenderedImage &image, const pt_stats &piece, const pt_error_estimate &error, std::uint32_t rows) {
    if (image.rows_done == 0) {
        image.stats = piece;
        image.error = error;
        return;
    }
    const auto mean = [&](double before, double of_piece) {
        return (before * image.rows_done + of_piece * rows) / (static_cast<double>(image.rows_done) + rows);
    };
    pt_stats &whole = image.stats;
    whole.sample_count = std::min(whole.sample_count, piece.sample_count);
    whole.max_sample_count = std::max(whole.max_sample_count, piece.max_sample_count);
    whole.mean_sample_count = mean(whole.mean_sample_count, piece.mean_sample_count);
    whole.rejected_samples += piece.rejected_samples;
    whole.device_bytes = std::max(whole.device_bytes, piece.device_bytes);
    whole.submit_count = piece.submit_count; // includes earlier pieces
    whole.device_seconds = piece.device_seconds;
    image.error.uncertain |= error.uncertain;
    using Error = pt_error_estimate;
    for (double Error::*const each : {&Error::rmse, &Error::rmse_low, &Error::rmse_high, &Error::relative_rmse,
                                      &Error::relative_rmse_low, &Error::relative_rmse_high}) {
        double &root = image.error.*each;
        root = std::sqrt(mean(root * root, error.*each * error.*each));
    }
}

bool add_piece(const Context &context, std::uint32_t rows, RenderedImage &image) {
    const pt_stats stats = context.stats();
    if (stats.sample_count == 0)
        return false;
    join(image, stats, context.error_estimate(), rows);
    const std::size_t first = std::size_t{3} * image.part.width * image.rows_done;
    context.read(image.part.x, image.part.width, rows, PT_QUANTITY_RADIANCE, &image.radiance[first]);
    for (PictureLayer &layer : image.layers)
        layer.read(context, image.part, image.rows_done, rows);
    image.rows_done += rows;
    return true;
}

} // namespace

std::uint32_t fit_pieces(const Context &context, const RenderTask &task) {
    const std::uint32_t height = task.window.part.height;
    std::uint32_t rows = task.options.piece_rows == 0 ? height : std::min(task.options.piece_rows, height);
    for (;; rows = (rows + 1) / 2) {
        const pt_render piece = piece_of(task, 0, 0, rows);
        const pt_result result = pt_set_render(context.get(), &piece);
        const bool too_large = result == PT_ERROR_UNSUPPORTED || result == PT_ERROR_OUT_OF_DEVICE_MEMORY;
        if (too_large && rows > 1)
            continue;
        require(context, task, result);
        return rows;
    }
}

ProgressStyle progress_style(const RenderOptions &options) {
    return progress_style(options.progress, options.output.quiet, platform::is_terminal(platform::standard_error));
}

ImageRender::ImageRender(const Context &context, const RenderTask &task, std::uint32_t rows, Stop stop,
                         WritePreview write_preview) :
    context_(context),
    task_(task),
    rows_(rows),
    stop_(std::move(stop)),
    write_preview_(task.options.frames || is_half() ? nullptr : std::move(write_preview)),
    progress_(std::cerr, progress_style(task.options), std::uint64_t{task.render.width} * task.window.part.height,
              std::uint64_t{task.sample_count} * task.half_count(), start_),
    stopping_(is_half() ? StoppingRules{} : task.options.stopping, start_) {
    constexpr double usual_checkpoint_seconds = 30.0;
    const RenderOptions &options = task.options;
    progress_.begin_at(context.stats().sample_count);
    if (options.stopping.time_limit > 0.0)
        progress_.limit_time(options.stopping.time_limit);
    if (!options.checkpoint.empty())
        checkpoint_.emplace(context, options.checkpoint, options.checkpoint_seconds.value_or(usual_checkpoint_seconds),
                            [this](const std::string &message) { progress_.say(message); });
}

ImageRender::Result ImageRender::run(const Round &round) {
    round_ = round;
    if (is_half())
        progress_.expect(std::uint64_t{round.expected} * task_.half_count());
    image_ = {.part = task_.window.part};
    image_.radiance.resize(3 * image_.part.pixel_count());
    if (round.half + 1 == task_.half_count() && (!round.film || round.film->empty()))
        for (const std::uint32_t layer : task_.options.wanted_layers())
            image_.layers.emplace_back(layer, image_.part.pixel_count());
    while (image_.rows_done < image_.part.height && !stop_()) {
        enter_piece();
        render_piece();
        if (!add_piece(context_, piece_rows_, image_))
            break;
    }
    if (image_.rows_done == 0) {
        image_.stats = context_.stats();
        image_.error = context_.error_estimate();
    }
    preview_task_.finish();
    if (round.film && !stop_())
        save_film(context_, *round.film);
    const bool has_checkpoint =
        checkpoint_ && checkpoint_->finish(static_cast<std::uint32_t>(std::lround(image_.stats.mean_sample_count)));
    return {std::move(image_), stopping_.ended_by(), has_checkpoint};
}

void ImageRender::enter_piece() {
    const pt_render piece = piece_of(task_, round_.half, image_.rows_done, rows_);
    if (image_.rows_done > 0 || is_half())
        context_.require(pt_set_render(context_.get(), &piece));
    if (round_.film && !round_.film->empty())
        add_film(context_, "the last round", *round_.film);
    piece_rows_ = piece.row_count;
    const double height = image_.part.height;
    const double end = (image_.rows_done + piece_rows_) / height;
    const double halves = task_.half_count();
    const double other = static_cast<double>(round_.other) / round_.expected;
    progress_.enter_part((other + image_.rows_done / height) / halves, (other + end) / halves);
    if (has_target()) // forecasts the count of the next check
        progress_.expect(forecast_sample_count(context_.stats().sample_count, 1.0, 1.0, task_.sample_count));
    stopping_.enter_piece(end);
}

// The library checks the error at sample counts that do not depend on the steps.
void ImageRender::render_piece() {
    constexpr std::uint32_t first_end = 16; // first count with a known error
    pt_stats done = context_.stats();
    std::uint32_t wanted = first_step_length;
    bool ended = done.sample_count >= round_.end;
    while (!ended && !stops()) {
        const std::uint32_t before = done.max_sample_count;
        std::uint32_t length = std::min(wanted, round_.end - before); // 0 completes pixels that lack samples
        if (has_target())
            length = std::min(length, std::max(first_end, 2 * std::bit_floor(before)) - before);
        const Clock::time_point start = Clock::now();
        const pt_result result = take(length, done.mean_sample_count);
        const double seconds = seconds_between(start, Clock::now());
        done = look(result);
        if (done.max_sample_count > before) // without new samples the duration says nothing
            wanted = next_step_length(done.max_sample_count - before, seconds);
        ended = has_ended(result, done);
    }
}

// `done` is the mean sample count before the step.
pt_result ImageRender::take(std::uint32_t length, double done) {
    std::function<bool(double)> goes_on = [&](double fraction) {
        const double taken = fraction * std::max(length, 1U);
        progress_.update_samples((done + taken) * task_.half_count(), Clock::now());
        const bool has_sample = taken >= 1.0;
        return !stops() && !(has_sample && pauses());
    };
    auto info = sized<pt_accumulate_info>();
    info.sample_count = length;
    info.stopping = stopping_.rules_of_step();
    info.sample_limit = has_target() ? round_.end : 0;
    info.sampling = task_.options.sampling;
    info.progress = &call_listener;
    info.progress_user = &goes_on;
    const pt_result result = pt_accumulate(context_.get(), &info);
    require(context_, task_, result);
    return result;
}

bool ImageRender::has_ended(pt_result result, const pt_stats &done) const {
    return result == PT_TARGET_REACHED || (result == PT_OK && done.max_sample_count >= round_.end);
}

// An error estimate reads the whole image. If only progress needs it, estimates take at most 1% of the time.
pt_stats ImageRender::look(pt_result result) {
    constexpr double share = 0.01;
    const Clock::time_point start = Clock::now();
    std::optional<pt_error_estimate> error;
    if (has_target() || (progress_.shows_error() && !is_half() && start >= next_error_))
        error = context_.error_estimate();
    const Clock::time_point now = Clock::now();
    if (error)
        next_error_ = now + clock_duration(seconds_between(start, now) / share);
    const pt_stats done = context_.stats();
    const bool ended = has_ended(result, done);
    show(done, ended, error, now);
    const auto sample_count = static_cast<std::uint32_t>(std::lround(done.mean_sample_count));
    if (sample_count > 0)
        preview(now);
    if (checkpoint_)
        checkpoint_->step(sample_count);
    stopping_.look(result);
    return done;
}

void ImageRender::show(const pt_stats &done, bool ended, const std::optional<pt_error_estimate> &error,
                       Clock::time_point now) {
    const auto sample_count = static_cast<std::uint32_t>(std::lround(done.mean_sample_count));
    if (error)
        progress_.show_error(error->relative_rmse);
    if (sample_count >= task_.sample_count || is_half())
        return;
    if (ended) {
        progress_.expect(sample_count);
        progress_.update_samples(sample_count, now);
    } else if (has_target()) {
        progress_.expect(forecast_sample_count(sample_count, error->relative_rmse_high, stopping_.rules().target_error,
                                               task_.sample_count));
    }
}

bool ImageRender::wants_preview() const {
    const double seconds = task_.options.preview_seconds.value_or(std::numeric_limits<double>::infinity());
    const bool is_due = !has_preview_failed_ && seconds_between(last_preview_, Clock::now()) >= seconds;
    return write_preview_ && (has_picture_request() || is_due) && !preview_task_.is_under_way();
}

void ImageRender::preview(Clock::time_point now) {
    if (!wants_preview())
        return;
    forget_picture_request();
    last_preview_ = now;
    preview_task_.finish();
    preview_ = image_;
    add_piece(context_, piece_rows_, preview_);
    preview_task_.start([this] { has_preview_failed_ = !write_preview_(preview_); });
}

bool ImageRender::pauses() const {
    return wants_preview() || (checkpoint_ && checkpoint_->is_due());
}

} // namespace cli
