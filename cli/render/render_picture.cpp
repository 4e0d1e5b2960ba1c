#include "cli/render/render_picture.h"

#include "cli/base/devices.h"
#include "cli/base/exit_code.h"
#include "cli/base/interrupt.h"
#include "cli/base/json_text.h"
#include "cli/base/message.h"
#include "cli/base/output_file.h"
#include "cli/base/progress.h"
#include "cli/base/source_date.h"
#include "cli/base/text.h"
#include "cli/film/film.h"
#include "cli/render/checkpoint.h"
#include "cli/render/observers.h"
#include "cli/render/piecewise_render.h"
#include "cli/render/render_output.h"
#include "cli/render/warnings.h"

#include <cmath>
#include <iostream>
#include <limits>
#include <optional>
#include <span>
#include <unistd.h>
#include <vector>

namespace cli {
namespace {

using Clock = std::chrono::steady_clock;
using WritePreview = std::function<bool(const PiecewiseImage &)>;

double seconds_since(Clock::time_point start) {
    return std::chrono::duration<double>(Clock::now() - start).count();
}

ProgressStyle style_of(const RenderOptions &options) {
    return progress_style(options.progress, options.output.quiet, isatty(STDERR_FILENO) == 1);
}

// False if that was stopped.
bool take_scene(const Context &context, const RenderTask &task, const Stop &superseded) {
    SceneProgress progress(std::cerr, style_of(task.options), Clock::now());
    return describe_scene(context, task.scene, [&](double share) {
        progress.update(share, Clock::now());
        return interrupt_signal() == 0 && !superseded();
    });
}

// What a rendering was asked to do beside its samples.
struct Extras {
    std::optional<PreviewObserver> preview; // of one picture: the file of a frame is to mean that it is done
    std::optional<CheckpointObserver> checkpoint;
    std::optional<TimeLimitObserver> time_limit; // which begins now

    Extras(const Context &context, const RenderOptions &options, Progress &progress, WritePreview write_preview) {
        constexpr double usual_seconds = 30.0;
        if (!options.frames) {
            preview.emplace(context, options.preview_seconds.value_or(std::numeric_limits<double>::infinity()),
                            std::move(write_preview));
        }
        if (!options.checkpoint.empty()) {
            checkpoint.emplace(context, options.checkpoint, options.checkpoint_seconds.value_or(usual_seconds),
                               [&progress](const std::string &message) { progress.say(message); });
        }
        if (options.time_limit) {
            time_limit.emplace(Clock::now(), *options.time_limit);
            progress.limit_time(*options.time_limit);
        }
    }

    std::vector<RenderObserver *> observers() {
        std::vector<RenderObserver *> all;
        if (preview)
            all.push_back(&*preview);
        if (checkpoint)
            all.push_back(&*checkpoint);
        if (time_limit)
            all.push_back(&*time_limit);
        return all;
    }

    // Once no more samples are taken: writes the last checkpoint, and waits for all that is being written.
    void finish(std::uint32_t sample_count) {
        if (preview)
            preview->finish();
        if (checkpoint)
            checkpoint->finish(sample_count);
    }
};

struct Rendered {
    PiecewiseImage image;
    bool timed_out;
    bool has_checkpoint;
};

Rendered render_with_progress(const Context &context, const RenderTask &task, std::uint32_t rows, const Stop &stop,
                              const WritePreview &write_preview) {
    const std::uint64_t pixel_count = std::uint64_t{task.render.width} * task.window.part.height;
    Progress progress(std::cerr, style_of(task.options), pixel_count, task.sample_count, Clock::now());
    progress.begin_at(context.sample_count());
    Extras extras(context, task.options, progress, write_preview);
    Rendered rendered{};
    rendered.image = render_pieces(context, task, rows, stop, progress, extras.observers());
    extras.finish(static_cast<std::uint32_t>(std::lround(rendered.image.stats.mean_sample_count)));
    rendered.timed_out = extras.time_limit && extras.time_limit->has_come();
    rendered.has_checkpoint = extras.checkpoint && extras.checkpoint->is_valid();
    return rendered;
}

// Of one piece of the image a film could not go on with the others.
void require_one_piece(const RenderTask &task, std::uint32_t rows) {
    const RenderOptions &options = task.options;
    const std::string option = !options.checkpoint.empty() ? "--checkpoint" : "--film";
    const bool is_asked = !options.checkpoint.empty() || !options.output.film.empty();
    if (is_asked && rows < task.window.part.height) {
        throw Failure(ExitCode::usage, option + ": needs the whole image on the device, which " +
                                           (options.piece_rows > 0 ? concat("--piece-rows ", rows, " forbids")
                                                                   : concat("has room for ", rows, " rows at a time")));
    }
}

// Takes over what the checkpoint has.
void resume_if_asked(const Context &context, const RenderTask &task) {
    const RenderOptions &options = task.options;
    if (!options.resume)
        return;
    const std::uint32_t sample_count = resume(context, task);
    if (!options.output.quiet) {
        print_message(options.checkpoint + (sample_count == 0 ? ": there is no checkpoint yet, so all samples are taken"
                                                              : concat(": goes on after ", sample_count, " of ",
                                                                       task.sample_count, " samples per pixel")));
    }
}

// An image that time has ended may have the target error as it is, and more samples to come for others to have it too.
const char *ending_of(const RenderReport &report, bool interrupted, bool timed_out) {
    if (interrupted)
        return "signal";
    if (timed_out)
        return "time";
    return report.target_reached() ? "error" : "samples";
}

// What an image in pieces takes of memory, before it is rendered.
void print_pieces(const Context &context, const RenderTask &task, std::uint32_t rows) {
    print_message(concat((task.window.part.height + rows - 1) / rows, " pieces of up to ", rows,
                         " rows: ", memory_text(context.read_stats().device_bytes), " on the device, ",
                         memory_text(image_bytes(task)), " for the image"));
}

void print_summary(const OutputOptions &output, const RenderReport &report, const std::vector<std::string> &written) {
    print_for_people("wrote " + listed(written) + ": " + summary_text(report) + "\n" + automatic_exposure_line(report) +
                         error_text(report) + "\n",
                     output.takes_standard_output());
}

PictureImages images_of(const PiecewiseImage &image) {
    return {image.radiance, image.standard_error, image.layers};
}

// Whether all images, and the film, could be written.
bool write_outputs(ImageWriter &writer, const Context &context, const RenderTask &task, RenderReport &report,
                   const PiecewiseImage &image, Clock::time_point start) {
    const OutputOptions &output = task.options.output;
    const std::vector<std::string> warnings = image_warnings(report, image.radiance);
    report.warnings.insert(report.warnings.end(), warnings.begin(), warnings.end());
    if (!output.quiet)
        print_warnings(warnings);
    std::vector<std::string> written = write_images(writer, output, report, images_of(image));
    if (!output.film.empty() && write_film([&] { return saved_film(context); }, output.film))
        written.push_back(output.film);
    report.total_seconds = seconds_since(start);
    write_report_file(output.stats, json_text(stats_json(report)));
    if (!output.quiet && !written.empty())
        print_summary(output, report, written);
    return written.size() == output_count(output) + (output.film.empty() ? 0 : 1);
}

// Nothing if no output is tone-mapped.
std::optional<ToneMap> tone_map_of(const RenderTask &task, std::span<const float> radiance) {
    return needs_tone_map(task.options.output) ? std::optional(task.scene.display.tone_map(radiance)) : std::nullopt;
}

void print_interruption(const RenderTask &task, std::uint32_t done, std::uint32_t rows_done,
                        const std::string &checkpoint) {
    const std::uint32_t height = task.window.part.height;
    print_message(
        concat("stopped by ", interrupt_name(), " after ", done, " of ", task.sample_count, " samples per pixel",
               done == 0             ? "; nothing was written"
               : rows_done == height ? ""
                                     : concat(" in ", rows_done, " of ", height, " rows; the others are black"),
               checkpoint.empty() ? "" : "; --resume goes on from " + checkpoint));
}

RenderReport report_of(const Context &context, const RenderTask &task) {
    RenderReport report{};
    report.scene = task.scene.path;
    report.date = source_date();
    report.render = task.render;
    report.window = task.window;
    report.requested_sample_count = task.sample_count;
    report.target_error = task.options.target_error;
    context.require(pt_get_context_device(context.get(), &report.device));
    return report;
}

} // namespace

int exit_code_of(Outcome outcome, int signal) {
    switch (outcome) {
    case Outcome::not_all_written:
        return static_cast<int>(ExitCode::file);
    case Outcome::target_missed:
        return static_cast<int>(ExitCode::target_missed);
    case Outcome::timed_out:
        return static_cast<int>(ExitCode::resumable);
    case Outcome::written:
    case Outcome::interrupted:
    case Outcome::superseded:
        break;
    }
    return signal == 0 ? static_cast<int>(ExitCode::done) : exit_code_of_signal(signal);
}

Outcome render_picture(const Context &context, const RenderTask &task, const RenderTimes &times,
                       const Stop &superseded) {
    const RenderOptions &options = task.options;
    RenderReport report = report_of(context, task);
    if (!take_scene(context, task, superseded)) {
        if (superseded())
            return Outcome::superseded;
        print_interruption(task, 0, 0, "");
        return Outcome::interrupted;
    }
    report.warnings = input_warnings(task.scene, options.target_error);
    if (!options.output.quiet)
        print_warnings(report.warnings);
    const std::uint32_t rows = fit_pieces(context, task);
    require_one_piece(task, rows);
    if (rows < task.window.part.height && !options.output.quiet)
        print_pieces(context, task, rows);
    report.create_seconds = seconds_since(times.create_start);

    // Not earlier: drivers are shared objects too, and loading one would wait for the loading of the image module.
    ImageWriter writer;
    if (needs_module(options.output))
        writer.load_module();
    resume_if_asked(context, task);
    const auto write_preview = [&](const PiecewiseImage &image) {
        RenderReport so_far = report;
        so_far.stats = image.stats;
        so_far.tone_map = tone_map_of(task, image.radiance);
        writer.wait();
        const OutputOptions files = without_standard_output(options.output); // a stream takes one image
        return write_images(writer, files, so_far, images_of(image)).size() == output_count(files);
    };
    const Stop stop = [&] { return interrupt_signal() != 0 || writer.failed() || superseded(); };
    const Clock::time_point accumulate_start = Clock::now();
    const Rendered rendered = render_with_progress(context, task, rows, stop, write_preview);
    const PiecewiseImage &image = rendered.image;
    report.accumulate_seconds = seconds_since(accumulate_start);
    report.total_seconds = seconds_since(times.start);

    report.stats = image.stats;
    const bool interrupted = interrupt_signal() != 0 && !superseded();
    report.ended_by = ending_of(report, interrupted, rendered.timed_out);
    const std::string checkpoint = rendered.has_checkpoint ? options.checkpoint : "";
    if (interrupted) {
        print_interruption(task, report.stats.sample_count, image.rows_done, checkpoint);
        if (report.stats.sample_count == 0)
            return Outcome::interrupted;
    } else if (superseded()) {
        return Outcome::superseded;
    }
    report.tone_map = tone_map_of(task, image.radiance);
    report.automatic_exposure = report.tone_map && !task.scene.display.exposure;
    writer.wait();
    const bool all_written = write_outputs(writer, context, task, report, image, times.start);
    if (interrupted && all_written)
        return Outcome::interrupted;
    return outcome_of(
        {task.has_target(), report.target_reached(), rendered.timed_out, rendered.has_checkpoint, all_written});
}

} // namespace cli
