#include "cli/figure/figure_command.h"

#include "cli/base/atomic_file.h"
#include "cli/base/distinct_files.h"
#include "cli/base/exit_code.h"
#include "cli/base/host_memory.h"
#include "cli/base/interrupt.h"
#include "cli/base/message.h"
#include "cli/base/report_file.h"
#include "cli/base/source_date.h"
#include "cli/base/vector_width.h"
#include "cli/figure/box_lines.h"
#include "cli/figure/figure_particles.h"
#include "cli/figure/figure_picture.h"
#include "cli/image/display_image.h"
#include "cli/image/exposure.h"
#include "cli/image/image_target.h"
#include "cli/render/outcome.h"
#include "cli/render/render_report.h"
#include "cli/scene/figure_scene.h"
#include "cli/scene/scene_setup.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <iostream>
#include <stdexcept>
#include <unistd.h>

namespace cli {
namespace {

using Clock = std::chrono::steady_clock;

void check_names(const FigureOptions &options) {
    if (options.outputs.empty() && options.scene.empty() && options.legend.empty()) {
        throw Failure(ExitCode::usage, "-o, --write-scene or --legend is missing: there is nothing to write");
    }
    check_image_names(options.outputs, options.format);
    std::vector<NamedFile> outputs{{"--legend", options.legend}, {"--write-scene", options.scene}};
    for (const std::string &path : options.outputs) {
        outputs.push_back({"-o", path});
        const ImageFormat format = image_target(path, options.format).format;
        if (options.background == FigureBackground::transparent && format == ImageFormat::jpeg) {
            throw Failure(ExitCode::usage, "--background transparent: -o " + path + ": JPEG has no alpha; .png has");
        }
    }
    if (options.data == standard_stream && !options.scene.empty()) {
        throw Failure(ExitCode::usage, "--write-scene: a scene names the file of its particles, which - is not");
    }
    require_distinct_files({{"the data", options.data}}, outputs);
    check_report_file(options.legend);
    check_report_file(options.scene);
}

RenderOptions render_options(const FigureOptions &options) {
    RenderOptions render;
    render.scene = options.data;
    render.seed = options.seed;
    render.display = options.display;
    return render;
}

pt_create_info create_info(const FigureOptions &options) {
    pt_create_info info{};
    info.struct_size = sizeof(pt_create_info);
    info.device = options.device.empty() ? nullptr : options.device.c_str();
    return info;
}

// The box, where it is to be seen.
std::optional<SimulationBox> shown_box(const FigureOptions &options, const SceneFile &scene) {
    return options.shows_box ? scene.particles.front().box : std::nullopt;
}

std::vector<Segment> lines_of(const FigureOptions &options, const SceneFile &scene) {
    const std::optional<SimulationBox> box = shown_box(options, scene);
    if (!box) {
        return {};
    }
    const auto edges = edges_of(*box);
    return {edges.begin(), edges.end()};
}

FigureLayout layout_of(const FigureOptions &options, const SceneFile &scene) {
    try {
        return lay_out(options.look, options.size, balls_of(scene), shown_box(options, scene));
    } catch (const std::invalid_argument &error) {
        throw Failure(ExitCode::usage, std::string("--floor: ") + error.what());
    }
}

// A line is as wide as a thousandth and a half of the picture is long, and never thinner than a pixel.
double line_width(const ImageSize &size) {
    return std::max(1.0, 0.0016 * std::max(size.width, size.height));
}

PiecewiseImage render_radiance(const Context &context, const FigureOptions &options, const SceneFile &scene,
                               const RenderSettings &settings) {
    const std::uint32_t rows = fit_pieces(context, scene, settings, 0);
    const ProgressStyle style = progress_style(options.progress, options.quiet, isatty(STDERR_FILENO) == 1);
    const std::uint64_t pixel_count = std::uint64_t{settings.render.width} * settings.render.height;
    Progress progress(std::cerr, style, pixel_count, settings.sample_count, Clock::now());
    const Stop stop = [] { return interrupt_signal() != 0; };
    return render_pieces(context, scene, settings, rows, {false, {}}, stop, progress, {});
}

void write_outputs(const FigureOptions &options, const RenderReport &report, const PiecewiseImage &image,
                   const ComposedFigure &figure) {
    ImageWriter writer;
    for (const std::string &path : options.outputs) {
        const ImageTarget target = image_target(path, options.format);
        if (target.format == ImageFormat::exr) {
            const ImageMetadata metadata(report, PT_QUANTITY_RADIANCE, nullptr);
            const std::vector<pt_image_layer> layers{{"", 3, PT_LAYER_COLOUR, image.radiance.data(), nullptr}};
            writer.write_radiance(target, report.window, layers, metadata.attributes());
        } else {
            const ImageMetadata metadata(report, PT_QUANTITY_RADIANCE, &report.tone_map.value());
            // Exposure and curve are in the light already; what is left is its encoding.
            write_display_image(writer, target, report.window, figure.light,
                                {0.0, ToneCurve::none, report.tone_map->gamma}, options.display.png_bits,
                                metadata.attributes(), figure.alpha);
        }
    }
}

std::uint32_t sample_count_of(const FigureOptions &options) {
    return options.sample_count.value_or(default_figure_samples);
}

// Returns the exit code.
int draw(const FigureOptions &options, SceneFile &scene, const FigureLayout &layout) {
    const auto start = Clock::now();
    const SceneFile stage = stage_scene(layout, options.data);
    furnish(scene, layout);
    scene.sample_count = sample_count_of(options);
    const RenderSettings settings = merge_settings(render_options(options), scene);
    require_host_memory(settings, options.data, 4);
    for (const std::string &path : options.outputs) {
        check_image_target(image_target(path, options.format), settings.window);
    }
    catch_interrupts();
    choose_vector_width();
    const Context context(create_info(options));

    RenderReport report{};
    report.scene = options.scene.empty() ? options.data : options.scene;
    report.date = source_date();
    report.render = settings.render;
    report.window = settings.window;
    report.requested_sample_count = settings.sample_count;
    context.require(pt_get_context_device(context.get(), &report.device));
    if (!describe_scene(context, scene, [](double) { return interrupt_signal() == 0; })) {
        return exit_code_of_signal(interrupt_signal());
    }
    const PiecewiseImage image = render_radiance(context, options, scene, settings);
    report.stats = image.stats;
    if (image.rows_done < settings.render.height) {
        print_message("stopped by " + interrupt_name() + "; no image was written");
        return exit_code_of_signal(interrupt_signal());
    }
    report.automatic_exposure = !settings.exposure.stops;
    report.tone_map = ToneMap{settings.exposure.stops ? *settings.exposure.stops : automatic_exposure(image.radiance),
                              settings.tone_curve, settings.gamma};
    const Balls balls = balls_of(scene);
    const std::vector<Segment> lines = lines_of(options, scene);
    const FigureContents contents{
        balls,
        {static_cast<std::uint32_t>(scene.spheres.size()), static_cast<std::uint32_t>(balls.count())},
        layout.camera,
        lines,
        line_width(layout.size),
        options.has_outlines};
    const Overlay overlay = read_overlay(context, contents, settings);
    const std::vector<float> behind = render_stage(context, stage, settings, layout.stage, image.stats.sample_count);
    write_outputs(options, report, image,
                  compose(image.radiance, behind, overlay, *report.tone_map, options.background));
    report.accumulate_seconds = std::chrono::duration<double>(Clock::now() - start).count();
    report.total_seconds = report.accumulate_seconds;
    if (!options.quiet) {
        const auto is_stream = [](const std::string &path) { return path == standard_stream; };
        print_for_people("wrote a figure of " + std::to_string(balls.count()) + " particles: " + summary_text(report) +
                             "\n",
                         std::any_of(options.outputs.begin(), options.outputs.end(), is_stream) ||
                             is_stream(options.legend) || is_stream(options.scene));
    }
    const int signal = interrupt_signal();
    return signal == 0 ? static_cast<int>(ExitCode::done) : exit_code_of_signal(signal);
}

} // namespace

int run_figure(const FigureOptions &options) {
    check_names(options);
    SceneFile scene{};
    scene.path = options.data;
    scene.particles.push_back(read_figure_particles(options));
    const ParticleEntry &particles = scene.particles.front();
    const FigureLayout layout = layout_of(options, scene);
    if (const std::string range = particles.chosen_range(); !range.empty() && !options.quiet) {
        print_message("--color: " + range);
    }
    if (!options.legend.empty()) {
        write_report_file(options.legend, legend_svg(legend_of(particles)));
    }
    if (!options.scene.empty()) {
        write_report_file(options.scene, figure_scene_text(layout, sample_count_of(options), particles));
    }
    return options.outputs.empty() ? static_cast<int>(ExitCode::done) : draw(options, scene, layout);
}

} // namespace cli
