#include "cli/render/render_command.h"

#include "cli/base/devices.h"
#include "cli/base/exit_code.h"
#include "cli/base/file.h"
#include "cli/base/interrupt.h"
#include "cli/base/json.h"
#include "cli/base/progress.h"
#include "cli/base/text.h"
#include "cli/film/film.h"
#include "cli/picture/denoise.h"
#include "cli/picture/picture_output.h"
#include "cli/render/warnings.h"

#include <pt/denoise.h>

#include <algorithm>
#include <array>
#include <iostream>
#include <optional>
#include <span>
#include <utility>
#include <vector>

namespace cli {
namespace {

using Clock = std::chrono::steady_clock;

double seconds_since(Clock::time_point start) {
    return std::chrono::duration<double>(Clock::now() - start).count();
}

bool take_scene(const Context &context, const RenderTask &task, const Stop &superseded) {
    Progress progress(std::cerr, progress_style(task.options), 0, 0, Clock::now());
    return describe_scene(context, task.scene, [&](double share) {
        progress.update_scene(share, Clock::now());
        return interrupt_signal() == 0 && !superseded();
    });
}

// A film holds only one piece, so outputs from the film need a single piece.
void require_one_piece(const RenderTask &task, std::uint32_t rows) {
    const RenderOptions &options = task.options;
    const std::string option = !options.checkpoint.empty()    ? "--checkpoint"
                               : !options.output.film.empty() ? "--film"
                               : task.has_rounds()            ? concat("--denoise with ", stopping_options)
                                                              : "";
    refuse_if(!option.empty() && rows < task.window.part.height,
              option + ": needs the whole image on the device, which " +
                  (options.piece_rows > 0 ? concat("--piece-rows ", rows, " forbids")
                                          : concat("has room for ", rows, " rows at a time")));
}

void resume_if_asked(const Context &context, const RenderTask &task) {
    const RenderOptions &options = task.options;
    if (!options.resume)
        return;
    const std::uint32_t sample_count = resume(context, task);
    if (!options.output.quiet) {
        print_message(options.checkpoint + (sample_count == 0 ? ": there is no checkpoint yet, so all samples are taken"
                                                              : concat(": continues after ", sample_count, " of ",
                                                                       task.sample_count, " samples per pixel")));
    }
}

// The target error may be reached although another rule ended the rendering.
std::string ending_of(const RenderReport &report, const ImageRender::Result &rendered, bool interrupted) {
    return interrupted ? "signal" : rendered.ended_by.value_or(report.target_reached ? "error" : "samples");
}

// A file that was not written decides first. A run that ended early can be resumed from its checkpoint.
ExitCode outcome_of(const StoppingRules &rules, const ImageRender::Result &rendered, bool all_written) {
    if (!all_written)
        return ExitCode::file;
    if (rendered.ended_by && rendered.has_checkpoint)
        return ExitCode::resumable;
    return rules.has_target() && !rules.is_reached(rendered.image.error) ? ExitCode::target_missed : ExitCode::done;
}

void print_pieces(const Context &context, const RenderTask &task, std::uint32_t rows) {
    print_message(concat((task.window.part.height + rows - 1) / rows, " pieces of up to ", rows,
                         " rows: ", memory_text(context.stats().device_bytes), " on the device, ",
                         memory_text(image_bytes(task)), " for the image"));
}

void print_summary(const OutputOptions &output, const RenderReport &report, const std::vector<std::string> &written) {
    print_for_people("wrote " + listed(written) + ": " + summary_text(report) + "\n" +
                         automatic_exposure_line(report.tone_map) + error_text(report) + "\n",
                     output.takes_standard_output());
}

bool write_outputs(ImageWriter &writer, const Context &context, const RenderTask &task, RenderReport &report,
                   const RenderedImage &image, Clock::time_point start) {
    const OutputOptions &output = task.options.output;
    const std::vector<std::string> warnings = image_warnings(report, image.radiance);
    report.warnings.insert(report.warnings.end(), warnings.begin(), warnings.end());
    if (!output.quiet)
        print_warnings(warnings);
    std::vector<std::string> written = write_images(writer, output, report, image);
    std::vector<std::byte> film;
    if (!output.film.empty())
        save_film(context, film);
    if (!output.film.empty() && write_film(output.film, film))
        written.push_back(output.film);
    report.total_seconds = seconds_since(start);
    write_report_file(output.stats, json_text(stats_json(report)));
    if (!output.quiet && !written.empty())
        print_summary(output, report, written);
    return written.size() == output.images.size() + (output.film.empty() ? 0 : 1);
}

std::optional<ToneMap> tone_map_of(const RenderTask &task, std::span<const float> radiance) {
    return needs_tone_map(task.options.output) ? std::optional(tone_map_for(task.scene.display, radiance))
                                               : std::nullopt;
}

// If a rule may end the rendering, both halves grow in rounds. After a stop the picture of the last round remains.
ImageRender::Result render_halves(const RenderTask &task, ImageRender &render, const Stop &stop) {
    const StoppingRules &rules = task.options.stopping;
    std::array<std::vector<std::byte>, 2> films;
    std::uint32_t done = 0;
    const auto add_round = [&](std::uint32_t end, const pt_error_estimate &error, Halves &halves) {
        const std::uint32_t expected = done > 0 && rules.has_target()
                                           ? std::max(end, forecast_sample_count(done, error.relative_rmse_high,
                                                                                 rules.target_error, task.sample_count))
                                           : task.sample_count;
        const auto run = [&](std::uint32_t half, std::uint32_t other) {
            return render.run({half, end, other, expected, task.has_rounds() ? &films[half] : nullptr}).image;
        };
        RenderedImage first = run(0, done);
        RenderedImage second = run(1, end);
        if (stop())
            return false;
        if (done > 0)
            second.layers = std::move(halves.second.layers);
        const auto guide = [&](std::uint32_t quantity) -> std::span<const float> {
            return std::ranges::find(second.layers, quantity, &PictureLayer::quantity)->values;
        };
        halves.albedo = guide(PT_QUANTITY_ALBEDO);
        halves.normal = guide(PT_QUANTITY_NORMAL);
        halves.first = std::move(first);
        halves.second = std::move(second);
        done = end;
        return true;
    };
    auto rounds = sized<pt_rounds_info>();
    rounds.sample_count = task.sample_count;
    rounds.stopping = rules;
    auto [image, ended] = denoised_rounds(task.options.denoiser, task.window.part, rounds, add_round);
    std::erase_if(image.layers, [&](const PictureLayer &each) {
        return std::ranges::count(task.options.output.layers, each.quantity) == 0;
    });
    ImageRender::Result result{};
    result.image = std::move(image);
    if (ended == PT_LIMIT_REACHED)
        result.ended_by = ended_by_time;
    return result;
}

void print_interruption(const RenderTask &task, std::uint32_t done, std::uint32_t rows_done,
                        const std::string &checkpoint) {
    const std::uint32_t height = task.window.part.height;
    print_message(concat("stopped by ", interrupt_name(), " after ", done, " of ",
                         task.sample_count * task.half_count(), " samples per pixel",
                         done == 0 ? "; nothing was written"
                         : rows_done == height
                             ? ""
                             : concat(" in ", rows_done, " of ", height, " rows; the others are black"),
                         checkpoint.empty() ? "" : "; --resume continues from " + checkpoint));
}

RenderReport report_of(const Context &context, const RenderTask &task) {
    RenderReport report{};
    report.scene = task.scene.path;
    report.render = task.render;
    report.window = task.window;
    report.requested_sample_count = task.sample_count * task.half_count();
    report.target_error = task.options.stopping.target_error;
    context.require(pt_get_context_device(context.get(), &report.device));
    return report;
}

} // namespace

ExitCode render_picture(const Context &context, const RenderTask &task, const RenderTimes &times,
                        const Stop &superseded) {
    const RenderOptions &options = task.options;
    RenderReport report = report_of(context, task);
    if (!take_scene(context, task, superseded)) {
        if (!superseded())
            print_interruption(task, 0, 0, "");
        return ExitCode::signal;
    }
    const std::uint32_t rows = fit_pieces(context, task);
    report.warnings = input_warnings(task.scene, context.warning(), options.stopping.target_error);
    if (!options.output.quiet)
        print_warnings(report.warnings);
    require_one_piece(task, rows);
    if (rows < task.window.part.height && !options.output.quiet)
        print_pieces(context, task, rows);
    report.create_seconds = seconds_since(times.create_start);

    // Not before the driver, whose loading would wait for this module.
    ImageWriter writer;
    if (needs_module(options.output))
        writer.load_module();
    resume_if_asked(context, task);
    const auto write_preview = [&](const RenderedImage &image) {
        RenderReport so_far = report;
        so_far.stats = image.stats;
        so_far.error = image.error;
        so_far.tone_map = tone_map_of(task, image.radiance);
        writer.wait();
        const OutputOptions files = without_standard_output(options.output); // standard output takes only one image
        return write_images(writer, files, so_far, image).size() == files.images.size();
    };
    const Stop stop = [&] { return interrupt_signal() != 0 || writer.failed() || superseded(); };
    const Clock::time_point accumulate_start = Clock::now();
    std::optional<ImageRender> render(std::in_place, context, task, rows, stop, write_preview);
    report.is_denoised = task.half_count() > 1;
    const ImageRender::Result rendered = report.is_denoised ? render_halves(task, *render, stop)
                                                            : render->run({0, task.sample_count, 0, task.sample_count});
    const RenderedImage &image = rendered.image;
    render.reset();
    report.accumulate_seconds = seconds_since(accumulate_start);
    report.total_seconds = seconds_since(times.start);

    report.stats = image.stats;
    report.error = image.error;
    report.target_reached = options.stopping.is_reached(image.error);
    const bool interrupted = interrupt_signal() != 0 && !superseded();
    report.ended_by = ending_of(report, rendered, interrupted);
    const std::string checkpoint = rendered.has_checkpoint ? options.checkpoint : "";
    if (interrupted) {
        print_interruption(task, report.stats.sample_count, image.rows_done, checkpoint);
        if (report.stats.sample_count == 0)
            return ExitCode::signal;
    } else if (superseded()) {
        return ExitCode::signal;
    }
    writer.wait();
    report.tone_map = tone_map_of(task, image.radiance);
    const bool all_written = write_outputs(writer, context, task, report, image, times.start);
    if (interrupted && all_written)
        return ExitCode::signal;
    return outcome_of(options.stopping, rendered, all_written);
}

} // namespace cli
