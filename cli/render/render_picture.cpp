#include "cli/render/render_picture.h"

#include "cli/base/device_text.h"
#include "cli/base/host_memory.h"
#include "cli/base/interrupt.h"
#include "cli/base/json_text.h"
#include "cli/base/message.h"
#include "cli/base/progress.h"
#include "cli/base/report_file.h"
#include "cli/base/source_date.h"
#include "cli/image/image_file.h"
#include "cli/render/piecewise_render.h"
#include "cli/render/render_output.h"
#include "cli/render/render_report.h"
#include "cli/scene/scene_setup.h"
#include "cli/scene/warnings.h"

#include <algorithm>
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

PiecewiseImage render_with_progress(const Context &context, const RenderOptions &options, const SceneFile &file,
                                    const RenderSettings &settings, std::uint32_t rows, const Stop &stop) {
    const std::uint64_t pixel_count = std::uint64_t{settings.render.width} * settings.window.part.height;
    Progress progress(std::cerr, style_of(options), pixel_count, settings.sample_count, Clock::now());
    return render_pieces(context, file, settings, rows, !options.standard_error.empty(), stop, progress);
}

// What an image in pieces takes of memory, before it is rendered.
void print_pieces(const Context &context, const RenderOptions &options, const ImageWindow &window, std::uint32_t rows) {
    const std::uint64_t host_bytes = image_bytes(window, options.standard_error.empty() ? 1 : 2);
    print_message(std::to_string((window.part.height + rows - 1) / rows) + " pieces of up to " + std::to_string(rows) +
                  " rows: " + memory_text(context.read_stats().device_bytes) + " on the device, " +
                  memory_text(host_bytes) + " for the image");
}

void print_summary(const RenderOptions &options, const RenderReport &report, const std::vector<std::string> &written) {
    std::string names;
    for (const std::string &path : written) {
        names += path + (&path == &written.back() ? ": " : ", ");
    }
    const std::string exposure = report.automatic_exposure ? exposure_text(report) + "\n" : "";
    print_for_people("wrote " + names + summary_text(report) + "\n" + exposure + error_text(report) + "\n",
                     takes_standard_output(options));
}

// Whether all images could be written.
bool write_outputs(ImageWriter &writer, const RenderOptions &options, RenderReport &report,
                   std::span<const float> radiance, std::span<const float> standard_error, Clock::time_point start) {
    const std::vector<std::string> warnings = image_warnings(report, radiance);
    report.warnings.insert(report.warnings.end(), warnings.begin(), warnings.end());
    if (!options.quiet) {
        print_warnings(warnings);
    }
    const std::vector<std::string> written = write_images(writer, options, report, radiance, standard_error);
    report.total_seconds = seconds_since(start);
    write_report_file(options.stats, json_text(stats_json(report)));
    if (!options.quiet && !written.empty()) {
        print_summary(options, report, written);
    }
    return written.size() == output_count(options);
}

// Nothing if no output is tone-mapped.
std::optional<ToneMap> tone_map_of(const RenderOptions &options, const RenderSettings &settings,
                                   std::span<const float> radiance) {
    if (!needs_tone_map(options)) {
        return std::nullopt;
    }
    const std::optional<double> stops = settings.exposure.stops;
    return ToneMap{stops ? *stops : automatic_exposure(radiance), settings.tone_curve, settings.gamma};
}

void print_interruption(const RenderSettings &settings, std::uint32_t done, std::uint32_t rows_done) {
    const std::uint32_t height = settings.window.part.height;
    const bool whole = rows_done == height;
    const std::string rows = std::to_string(rows_done) + " of " + std::to_string(height) + " rows";
    print_message("stopped by " + interrupt_name() + " after " + std::to_string(done) + " of " +
                  std::to_string(settings.sample_count) + " samples per pixel" +
                  (done == 0 ? "; nothing was written"
                   : whole   ? ""
                             : " in " + rows + "; the others are black"));
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
        if (superseded()) {
            return Outcome::superseded;
        }
        print_interruption(settings, 0, 0);
        return Outcome::interrupted;
    }
    report.warnings = input_warnings(file, settings);
    if (!options.quiet) {
        print_warnings(report.warnings);
    }
    const std::uint32_t rows = fit_pieces(context, file, settings, options.piece_rows);
    if (rows < settings.window.part.height && !options.quiet) {
        print_pieces(context, options, settings.window, rows);
    }
    report.create_seconds = seconds_since(times.create_start);

    // Not earlier: drivers are shared objects too, and loading one would wait for the loading of the image module.
    ImageWriter writer;
    if (needs_module(options)) {
        writer.load_module();
    }
    const Stop stop = [&] { return interrupt_signal() != 0 || writer.failed() || superseded(); };
    const Clock::time_point accumulate_start = Clock::now();
    const PiecewiseImage image = render_with_progress(context, options, file, settings, rows, stop);
    report.accumulate_seconds = seconds_since(accumulate_start);
    report.total_seconds = seconds_since(times.start);

    report.stats = image.stats;
    const bool interrupted = interrupt_signal() != 0 && !superseded();
    if (interrupted) {
        print_interruption(settings, report.stats.sample_count, image.rows_done);
        if (report.stats.sample_count == 0) {
            return Outcome::interrupted;
        }
    } else if (superseded()) {
        return Outcome::superseded;
    }
    report.tone_map = tone_map_of(options, settings, image.radiance);
    report.automatic_exposure = report.tone_map && !settings.exposure.stops;
    writer.wait();
    if (!write_outputs(writer, options, report, image.radiance, image.standard_error, times.start)) {
        return Outcome::not_all_written;
    }
    if (interrupted) {
        return Outcome::interrupted;
    }
    const bool missed = report.target_error > 0.0 && !report.target_reached();
    return missed ? Outcome::target_missed : Outcome::written;
}

} // namespace cli
