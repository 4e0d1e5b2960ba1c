#include "cli/bench/bench_options.h"

#include "cli/base/common_options.h"
#include "cli/base/method_names.h"

#include <algorithm>
#include <functional>

namespace cli {
namespace {

// "16,64" -> read("16"), read("64"); an empty part is handed on and refused there.
void for_each_part(const std::string &text, const std::function<void(const std::string &)> &read) {
    for (std::size_t begin = 0; begin <= text.size();) {
        const std::size_t end = std::min(text.find(',', begin), text.size());
        read(text.substr(begin, end - begin));
        begin = end + 1;
    }
}

template <std::size_t Count>
CLI::Option *add_methods(CLI::App &command, const std::string &name, std::vector<std::uint32_t> &target,
                         const std::string &kind, const MethodNames<Count> &methods, const std::string &help) {
    const auto find = [&methods](std::string_view part) { return methods.find(part); };
    const auto read = [&target, &methods, find, name, kind](const std::string &text) {
        target.clear();
        for_each_part(text, [&](const std::string &part) {
            const std::uint32_t method = read_name(name, part, find, kind, methods.names());
            if (std::find(target.begin(), target.end(), method) == target.end()) {
                target.push_back(method);
            }
        });
    };
    return command.add_option_function<std::string>(name, read, help)
        ->type_name(alternatives(methods.names()) + ",...");
}

CLI::Option *add_sample_counts(CLI::App &command, std::vector<std::uint32_t> &target) {
    const auto read = [&target](const std::string &text) {
        target.clear();
        for_each_part(text, [&](const std::string &part) {
            target.push_back(read_option_number<std::uint32_t>("--spp", part, 1));
        });
        std::sort(target.begin(), target.end());
        target.erase(std::unique(target.begin(), target.end()), target.end());
    };
    return command.add_option_function<std::string>("--spp", read, "Samples per pixel (default: 16,64,256,1024)")
        ->type_name("N,...");
}

CLI::Option *add_target_errors(CLI::App &command, std::vector<double> &target) {
    const auto read = [&target](const std::string &text) {
        target.clear();
        for_each_part(text, [&](const std::string &part) { target.push_back(read_target_error("--errors", part)); });
        std::sort(target.begin(), target.end(), std::greater());
        target.erase(std::unique(target.begin(), target.end()), target.end());
    };
    return command
        .add_option_function<std::string>(
            "--errors", read,
            "In place of --spp: until the stated error is at or below these, like 4%,1%, with samples where they "
            "lessen it most")
        ->type_name("E,...");
}

} // namespace

const char *const bench_help =
    "Every sampler, estimator and sample count is rendered in every round, in turn, with a seed of the round's own;\n"
    "compiling the kernel is not timed. Columns: seconds (wall clock, median of the rounds) and cpu s (of all threads\n"
    "of this process) are of the sampling alone; MSE and relMSE, the mean of (x-r)^2/(r^2+0.01), are means of the\n"
    "rounds against the reference r; efficiency is 1/(relMSE seconds); slope is that of log MSE against log N since\n"
    "the count above, -1 for independent samples. halton uses the same points in every pixel, whatever the seed: its\n"
    "rounds differ little.\n";

BenchOptions::BenchOptions() : estimators{PT_ESTIMATOR_BEST} {
    for (const std::string_view name : cli::samplers.names()) {
        const std::uint32_t sampler = cli::samplers.find(name).value();
        if (sampler != PT_SAMPLER_BEST) { // which is one of the others
            samplers.push_back(sampler);
        }
    }
}

void add_bench_options(CLI::App &command, BenchOptions &options) {
    command.add_option("SCENE", options.scene, "Scene file (JSON); - is standard input")
        ->required()
        ->type_name("SCENE");
    add_size(command, options.size);
    add_max_path_length(command, options.max_path_length);
    add_methods(command, "--samplers", options.samplers, "sampler", samplers,
                "Samplers to compare (default: all but best)");
    add_methods(command, "--estimators", options.estimators, "estimator", estimators,
                "Estimators to compare (default: best)");
    CLI::Option *sample_counts = add_sample_counts(command, options.sample_counts);
    add_target_errors(command, options.target_errors)->excludes(sample_counts);
    add_whole_number<std::uint32_t>(command, "--rounds", options.round_count, 1, "Repetitions (default: 3)");
    add_seed(command, options.seed);
    add_device(command, options.device);
    CLI::Option *reference = command.add_option("--reference", options.reference,
                                                "Image (.exr) of the same size to compare with (default: rendered "
                                                "first)");
    reference->type_name("EXR");
    add_whole_number<std::uint32_t>(command, "--reference-spp", options.reference_sample_count, 2,
                                    "Samples per pixel of the reference that is rendered (default: 64 times the "
                                    "largest of --spp)")
        ->excludes(reference);
    command.add_option("--csv", options.csv, "Write the table as CSV; - is standard output, as with --json")
        ->type_name("CSV");
    command
        .add_option("--json", options.json,
                    "Write the table and all conditions as JSON; - is standard output, the table then goes to stderr")
        ->type_name("JSON");
    add_reporting(command, options.progress, options.quiet);
}

} // namespace cli
