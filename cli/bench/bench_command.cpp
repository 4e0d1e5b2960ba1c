#include "cli/bench/bench_command.h"

#include "cli/base/context.h"
#include "cli/base/distinct_files.h"
#include "cli/base/exit_code.h"
#include "cli/base/host_memory.h"
#include "cli/base/interrupt.h"
#include "cli/base/json_text.h"
#include "cli/base/message.h"
#include "cli/base/progress.h"
#include "cli/base/report_file.h"
#include "cli/base/vector_width.h"
#include "cli/bench/bench_report.h"
#include "cli/bench/bench_run.h"
#include "cli/image/image_reader.h"
#include "cli/scene/render_settings.h"
#include "cli/scene/scene_completion.h"
#include "cli/scene/scene_setup.h"

#include <algorithm>
#include <cmath>
#include <iostream>
#include <limits>
#include <unistd.h>

namespace cli {
namespace {

RenderSettings bench_settings(const BenchOptions &options, const SceneFile &file) {
    RenderOptions render;
    render.size = options.size;
    render.max_path_length = options.max_path_length;
    render.seed = options.seed;
    return merge_settings(render, file);
}

// Its error is then an eighth of the smallest error measured, if the error's square falls with 1 / N.
std::uint32_t reference_sample_count(const BenchOptions &options) {
    constexpr std::uint32_t factor = 64;
    if (options.reference_sample_count) {
        return *options.reference_sample_count;
    }
    if (!options.target_errors.empty()) {
        throw Failure(ExitCode::usage, "--errors: needs --reference or --reference-spp, since it is not known how many "
                                       "samples they take");
    }
    const std::uint32_t largest = options.sample_counts.back();
    if (largest > std::numeric_limits<std::uint32_t>::max() / factor) {
        throw Failure(ExitCode::usage, "--spp " + std::to_string(largest) +
                                           ": 64 times as many for the reference are too many; give --reference-spp");
    }
    return factor * largest;
}

std::vector<float> read_reference(const std::string &path, const pt_render &render) {
    RadianceImage image = read_radiance(path);
    if (image.width != render.width || image.height != render.height) {
        const auto size = [](std::uint32_t width, std::uint32_t height) {
            return std::to_string(width) + "x" + std::to_string(height);
        };
        throw Failure(ExitCode::usage, "--reference " + path + ": is " + size(image.width, image.height) +
                                           ", the picture is " + size(render.width, render.height));
    }
    if (!std::all_of(image.radiance.begin(), image.radiance.end(), [](float value) { return std::isfinite(value); })) {
        throw Failure(ExitCode::file, "--reference " + path + ": holds a number that is not finite");
    }
    return std::move(image.radiance);
}

std::vector<BenchCell> make_cells(const BenchOptions &options) {
    std::vector<BenchCell> cells;
    for (const std::uint32_t sampler : options.samplers) {
        for (const std::uint32_t estimator : options.estimators) {
            if (options.target_errors.empty()) {
                for (const std::uint32_t sample_count : options.sample_counts) {
                    cells.push_back({sampler, estimator, sample_count, 0.0, {}});
                }
            }
            for (const double target_error : options.target_errors) {
                cells.push_back({sampler, estimator, default_most_samples, target_error, {}});
            }
        }
    }
    return cells;
}

std::uint64_t total_sample_count(const BenchReport &report) {
    std::uint64_t total = 0;
    for (const BenchCell &cell : report.cells) {
        total += std::uint64_t{expected_sample_count(cell)} * report.requested_round_count;
    }
    return total + report.reference.sample_count;
}

// Measures all cells in every round, so that a machine that slows down or is disturbed does so to all alike, until a
// signal comes. If the reference is empty, it is rendered first.
void measure(const Context &context, const SceneFile &file, const RenderSettings &settings, const BenchOptions &options,
             std::vector<float> reference, BenchReport &report) {
    const std::uint64_t pixel_count = std::uint64_t{report.render.width} * report.render.height;
    const std::uint64_t total = total_sample_count(report);
    Progress progress(std::cerr, progress_style(options.progress, options.quiet, isatty(STDERR_FILENO) == 1),
                      pixel_count, total, Progress::Clock::now());
    BenchRunner runner(context, file, settings, progress, total);
    if (reference.empty()) {
        auto rendered = runner.render_reference(report.reference.sample_count, report.reference.noise.emplace());
        if (!rendered) {
            return;
        }
        reference = std::move(*rendered);
    }
    for (std::uint32_t round = 0; round < report.requested_round_count; ++round) {
        for (BenchCell &cell : report.cells) {
            const auto run = runner.measure(cell, report.render.seed + 1 + round, reference);
            if (!run) {
                return;
            }
            cell.runs.push_back(*run);
        }
    }
}

void write_report(const BenchOptions &options, const BenchReport &report) {
    if (!options.quiet) {
        print_for_people(bench_table(report), options.json == standard_stream || options.csv == standard_stream);
    }
    write_report_file(options.json, json_text(bench_json(report)));
    write_report_file(options.csv, bench_csv(report));
}

} // namespace

int run_bench(const BenchOptions &options) {
    require_distinct_files({{"the scene", options.scene}, {"--reference", options.reference}},
                           {{"--csv", options.csv}, {"--json", options.json}});
    const SceneFile file = read_scene_file(options.scene, options.size);
    choose_vector_width(); // before the module that reads images starts threads
    const RenderSettings settings = bench_settings(options, file);
    require_host_memory(settings, file.path, 2); // the reference, and the one compared with it
    check_report_file(options.csv);
    check_report_file(options.json);

    BenchReport report{};
    report.scene = file.path;
    report.render = settings.render;
    report.requested_round_count = options.round_count;
    report.cells = make_cells(options);
    std::vector<float> reference;
    if (options.reference.empty()) {
        report.reference.seed = settings.render.seed;
        report.reference.sample_count = reference_sample_count(options);
    } else {
        report.reference.path = options.reference;
        reference = read_reference(options.reference, settings.render);
    }

    catch_interrupts();
    pt_create_info info{};
    info.struct_size = sizeof(pt_create_info);
    info.device = options.device.empty() ? nullptr : options.device.c_str();
    const Context context(info);
    context.require(pt_get_context_device(context.get(), &report.device));
    describe(context, file, settings);
    measure(context, file, settings, options, std::move(reference), report);

    const bool any =
        std::any_of(report.cells.begin(), report.cells.end(), [](const BenchCell &cell) { return !cell.runs.empty(); });
    if (any) {
        write_report(options, report);
    }
    if (interrupt_signal() == 0) {
        return static_cast<int>(ExitCode::done);
    }
    print_message(
        "stopped by " + interrupt_name() +
        (any ? "; the runs done so far are reported" : " before the first run was done; nothing was written"));
    return exit_code_of_signal(interrupt_signal());
}

} // namespace cli
