#include "cli/render/render_picture.h"

#include "cli/base/device_text.h"
#include "cli/base/host_memory.h"
#include "cli/base/interrupt.h"
#include "cli/base/json_text.h"
#include "cli/base/message.h"
#include "cli/base/progress.h"
#include "cli/base/report_file.h"
#include "cli/base/source_date.h"
#include "cli/film/context_film.h"
#include "cli/image/image_file.h"
#include "cli/render/picture_observers.h"
#include "cli/render/piecewise_render.h"
#include "cli/render/render_output.h"
#include "cli/render/render_report.h"
#include "cli/render/resume.h"
#include "cli/scene/scene_setup.h"
#include "cli/scene/warnings.h"

#include <cmath>
#include <iostream>
#include <optional>
#include <span>
#include <unistd.h>
#include <vector>

namespace cli {
namespace {

using Clock = std::chrono::steady_clock;

double seconds_since(Clock::time_point start) {
    return std::chrono::duration<double>(Clock::now() - start).count();
}

ProgressStyle style_of(const RenderOptions &options) {
    return progress_style(options.progress, options.quiet, isatty(STDERR_FILENO) == 1);
}

// False if that was stopped.
bool take_scene(const Context &context, const RenderOptions &options, const SceneFile &file, const Stop &superseded) {
    SceneProgress progress(std::cerr, style_of(options), Clock::now());
    return describe_scene(context, file, [&](double share) {
        progress.update(share, Clock::now());
        return interrupt_signal() == 0 && !superseded();
    });
}

struct Rendered {
    PiecewiseImage image;
    bool timed_out;
    bool has_checkpoint;
};

Rendered render_with_progress(const Context &context, const RenderOptions &options, const SceneFile &file,
                              const RenderSettings &settings, std::uint32_t rows, const Stop &stop,
                              const std::function<bool(const PiecewiseImage &)> &write_preview) {
    const std::uint64_t pixel_count = std::uint64_t{settings.render.width} * settings.window.part.height;
    Progress progress(std::cerr, style_of(options), pixel_count, settings.sample_count, Clock::now());
    progress.begin_at(context.sample_count());
    PictureObservers observers(context, options, progress, write_preview);
    Rendered rendered{};
    const std::vector<std::uint32_t> layers = wanted_layers(options);
    const WantedImages wanted{!options.standard_error.empty(), layers};
    rendered.image = render_pieces(context, file, settings, rows, wanted, stop, progress, observers.list());
    observers.finish(static_cast<std::uint32_t>(std::lround(rendered.image.stats.mean_sample_count)));
    rendered.timed_out = observers.is_timed_out();
    rendered.has_checkpoint = observers.has_checkpoint();
    return rendered;
}

// Of one piece of the image a film could not go on with the others.
void require_one_piece(const RenderOptions &options, const RenderSettings &settings, std::uint32_t rows) {
    const std::string option = !options.checkpoint.empty() ? "--checkpoint" : "--film";
    const bool is_asked = !options.checkpoint.empty() || !options.film.empty();
    if (is_asked && rows < settings.window.part.height) {
        throw Failure(ExitCode::usage,
                      option + ": needs the whole image on the device, which " +
                          (options.piece_rows > 0 ? "--piece-rows " + std::to_string(rows) + " forbids"
                                                  : "has room for " + std::to_string(rows) + " rows at a time"));
    }
}

// Takes over what the checkpoint has.
void resume_if_asked(const Context &context, const RenderOptions &options, const RenderSettings &settings) {
    if (!options.resume)
        return;
    const std::uint32_t sample_count = resume(context, options.checkpoint, settings);
    if (!options.quiet) {
        print_message(sample_count == 0 ? options.checkpoint + ": there is no checkpoint yet, so all samples are taken"
                                        : options.checkpoint + ": goes on after " + std::to_string(sample_count) +
                                              " of " + std::to_string(settings.sample_count) + " samples per pixel");
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
void print_pieces(const Context &context, const RenderOptions &options, const ImageWindow &window, std::uint32_t rows) {
    const std::uint64_t host_bytes = image_bytes(window, image_count(options));
    print_message(std::to_string((window.part.height + rows - 1) / rows) + " pieces of up to " + std::to_string(rows) +
                  " rows: " + memory_text(context.read_stats().device_bytes) + " on the device, " +
                  memory_text(host_bytes) + " for the image");
}

void print_summary(const RenderOptions &options, const RenderReport &report, const std::vector<std::string> &written) {
    std::string names;
    for (const std::string &path : written)
        names += path + (&path == &written.back() ? ": " : ", ");
    const std::string exposure = report.automatic_exposure ? exposure_text(report) + "\n" : "";
    print_for_people("wrote " + names + summary_text(report) + "\n" + exposure + error_text(report) + "\n",
                     takes_standard_output(options));
}

PictureImages images_of(const PiecewiseImage &image) {
    return {image.radiance, image.standard_error, image.layers};
}

// Whether all images, and the film, could be written.
bool write_outputs(ImageWriter &writer, const Context &context, const RenderOptions &options, RenderReport &report,
                   const PiecewiseImage &image, Clock::time_point start) {
    const std::vector<std::string> warnings = image_warnings(report, image.radiance);
    report.warnings.insert(report.warnings.end(), warnings.begin(), warnings.end());
    if (!options.quiet)
        print_warnings(warnings);
    std::vector<std::string> written = write_images(writer, options, report, images_of(image));
    if (!options.film.empty() && write_film([&] { return saved_film(context); }, options.film))
        written.push_back(options.film);
    report.total_seconds = seconds_since(start);
    write_report_file(options.stats, json_text(stats_json(report)));
    if (!options.quiet && !written.empty())
        print_summary(options, report, written);
    return written.size() == output_count(options) + (options.film.empty() ? 0 : 1);
}

// Nothing if no output is tone-mapped.
std::optional<ToneMap> tone_map_of(const RenderOptions &options, const RenderSettings &settings,
                                   std::span<const float> radiance) {
    if (!needs_tone_map(options))
        return std::nullopt;
    const std::optional<double> stops = settings.exposure.stops;
    return ToneMap{stops ? *stops : automatic_exposure(radiance), settings.tone_curve, settings.gamma};
}

void print_interruption(const RenderSettings &settings, std::uint32_t done, std::uint32_t rows_done,
                        const std::string &checkpoint) {
    const std::uint32_t height = settings.window.part.height;
    const bool whole = rows_done == height;
    const std::string rows = std::to_string(rows_done) + " of " + std::to_string(height) + " rows";
    print_message("stopped by " + interrupt_name() + " after " + std::to_string(done) + " of " +
                  std::to_string(settings.sample_count) + " samples per pixel" +
                  (done == 0 ? "; nothing was written"
                   : whole   ? ""
                             : " in " + rows + "; the others are black") +
                  (checkpoint.empty() ? "" : "; --resume goes on from " + checkpoint));
}

} // namespace

Outcome render_picture(const Context &context, const RenderOptions &options, const SceneFile &file,
                       const RenderSettings &settings, const RenderTimes &times, const Stop &superseded) {
    RenderReport report{};
    report.scene = file.path;
    report.date = source_date();
    report.render = settings.render;
    report.window = settings.window;
    report.requested_sample_count = settings.sample_count;
    report.target_error = settings.target_error;

    context.require(pt_get_context_device(context.get(), &report.device));
    if (!take_scene(context, options, file, superseded)) {
        if (superseded())
            return Outcome::superseded;
        print_interruption(settings, 0, 0, "");
        return Outcome::interrupted;
    }
    report.warnings = input_warnings(file, settings);
    if (!options.quiet)
        print_warnings(report.warnings);
    const std::uint32_t rows = fit_pieces(context, file, settings, options.piece_rows);
    require_one_piece(options, settings, rows);
    if (rows < settings.window.part.height && !options.quiet)
        print_pieces(context, options, settings.window, rows);
    report.create_seconds = seconds_since(times.create_start);

    // Not earlier: drivers are shared objects too, and loading one would wait for the loading of the image module.
    ImageWriter writer;
    if (needs_module(options))
        writer.load_module();
    resume_if_asked(context, options, settings);
    const auto write_preview = [&](const PiecewiseImage &image) {
        RenderReport so_far = report;
        so_far.stats = image.stats;
        so_far.tone_map = tone_map_of(options, settings, image.radiance);
        writer.wait();
        const RenderOptions files = without_standard_output(options); // a stream takes one image
        return write_images(writer, files, so_far, images_of(image)).size() == output_count(files);
    };
    const Stop stop = [&] { return interrupt_signal() != 0 || writer.failed() || superseded(); };
    const Clock::time_point accumulate_start = Clock::now();
    const Rendered rendered = render_with_progress(context, options, file, settings, rows, stop, write_preview);
    const PiecewiseImage &image = rendered.image;
    report.accumulate_seconds = seconds_since(accumulate_start);
    report.total_seconds = seconds_since(times.start);

    report.stats = image.stats;
    const bool interrupted = interrupt_signal() != 0 && !superseded();
    report.ended_by = ending_of(report, interrupted, rendered.timed_out);
    report.checkpoint = rendered.has_checkpoint ? options.checkpoint : "";
    if (interrupted) {
        print_interruption(settings, report.stats.sample_count, image.rows_done, report.checkpoint);
        if (report.stats.sample_count == 0)
            return Outcome::interrupted;
    } else if (superseded()) {
        return Outcome::superseded;
    }
    report.tone_map = tone_map_of(options, settings, image.radiance);
    report.automatic_exposure = report.tone_map && !settings.exposure.stops;
    writer.wait();
    const bool all_written = write_outputs(writer, context, options, report, image, times.start);
    if (interrupted && all_written)
        return Outcome::interrupted;
    return outcome_of(
        {report.target_error > 0.0, report.target_reached(), rendered.timed_out, rendered.has_checkpoint, all_written});
}

} // namespace cli
