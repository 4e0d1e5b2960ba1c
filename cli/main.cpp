// The program `pt`: chooses the subcommand, and turns every exception into an exit code.
#include "cli/base/devices_command.h"
#include "cli/base/exit_code.h"
#include "cli/base/json_text.h"
#include "cli/base/message.h"
#include "cli/base/standard_streams.h"
#include "cli/base/unknown_argument.h"
#include "cli/bench/bench_command.h"
#include "cli/bench/bench_options.h"
#include "cli/compare/compare_command.h"
#include "cli/film/merge_command.h"
#include "cli/film/merge_options.h"
#include "cli/render/render_command.h"
#include "cli/render/render_options.h"
#include "cli/render/render_report.h"
#include "cli/scene/scene_schema.h"
#include "cli/selftest/selftest_command.h"
#include "cli/tonemap/tonemap_command.h"

#include <CLI/CLI.hpp>

#include <exception>
#include <iostream>
#include <new>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

namespace {

int fail(cli::ExitCode code, const std::string &message) {
    cli::print_message(message);
    return static_cast<int>(code);
}

int parse_and_run(int argument_count, char **arguments) {
    CLI::App program("pt: an offscreen path tracer for spheres and planes on any Vulkan device", "pt");
    program.require_subcommand(0, 1);
    program.footer(cli::exit_code_help);
    program.set_version_flag("--version", "pt " + cli::version_text());

    cli::RenderOptions options;
    CLI::App *render = program.add_subcommand("render", "Render a scene file to images");
    cli::add_render_options(*render, options);
    render->footer(std::string(cli::render_help) + "\n" + cli::exit_code_help);

    cli::TonemapOptions tonemap_options;
    CLI::App *tonemap = program.add_subcommand("tonemap", "Make a picture of a file of radiance, without rendering");
    cli::add_tonemap_options(*tonemap, tonemap_options);
    tonemap->footer(std::string(cli::tonemap_help) + "\n" + cli::exit_code_help);

    cli::CompareOptions compare_options;
    CLI::App *compare = program.add_subcommand("compare", "Compare an image with a reference");
    cli::add_compare_options(*compare, compare_options);
    compare->footer(std::string(cli::compare_help) + "\n" + cli::exit_code_help);

    cli::BenchOptions bench_options;
    CLI::App *bench = program.add_subcommand("bench", "Measure the error and the time of samplers and estimators");
    cli::add_bench_options(*bench, bench_options);
    bench->footer(std::string(cli::bench_help) + "\n" + cli::exit_code_help);

    cli::MergeOptions merge_options;
    CLI::App *merge = program.add_subcommand("merge", "Add films of one picture that were rendered apart");
    cli::add_merge_options(*merge, merge_options);
    merge->footer(std::string(cli::merge_help) + "\n" + cli::exit_code_help);

    cli::SelftestOptions selftest_options;
    CLI::App *selftest = program.add_subcommand("selftest", "Check a device against exact answers, in a second or so");
    cli::add_selftest_options(*selftest, selftest_options);
    selftest->footer(std::string(cli::selftest_help) + "\n" + cli::exit_code_help);

    CLI::App *schema = program.add_subcommand("schema", "Print the JSON Schema of scene files");

    bool as_json = false;
    CLI::App *devices = program.add_subcommand("devices", "List the Vulkan devices");
    devices->add_flag("--json", as_json, "Print JSON");

    try {
        program.parse(argument_count, arguments);
    } catch (const CLI::ParseError &error) {
        if (error.get_exit_code() == static_cast<int>(CLI::ExitCodes::Success)) {
            return program.exit(error); // --help and --version
        }
        const std::vector<CLI::App *> parsed = program.get_subcommands();
        const CLI::App &command = parsed.empty() ? program : *parsed.front();
        const std::string name = parsed.empty() ? "" : command.get_name() + " ";
        return fail(cli::ExitCode::usage,
                    cli::unknown_argument(command).value_or(error.what()) + " (see pt " + name + "--help)");
    }
    if (render->parsed()) {
        return cli::run_render(options);
    }
    if (tonemap->parsed()) {
        return cli::run_tonemap(tonemap_options);
    }
    if (compare->parsed()) {
        return cli::run_compare(compare_options);
    }
    if (bench->parsed()) {
        return cli::run_bench(bench_options);
    }
    if (merge->parsed()) {
        return cli::run_merge(merge_options);
    }
    if (selftest->parsed()) {
        return cli::run_selftest(selftest_options);
    }
    if (schema->parsed()) {
        std::cout << cli::json_text(cli::scene_schema());
        return static_cast<int>(cli::ExitCode::done);
    }
    if (devices->parsed()) {
        return cli::run_devices(as_json);
    }
    return fail(cli::ExitCode::usage,
                "a subcommand is missing: render, tonemap, compare, bench, merge, selftest, schema or devices (see pt "
                "--help)");
}

} // namespace

int main(int argument_count, char **arguments) {
    cli::occupy_closed_streams();
    int code = 0;
    try {
        code = parse_and_run(argument_count, arguments);
    } catch (const cli::Failure &failure) {
        return fail(failure.code(), failure.what());
    } catch (const std::bad_alloc &) {
        return fail(cli::ExitCode::internal, "out of memory");
    } catch (const std::exception &error) {
        return fail(cli::ExitCode::internal, std::string("internal error: ") + error.what());
    }
    // An earlier failure takes precedence, for example the signal of a terminal that was closed.
    if (!std::cout.flush()) {
        const int output_code = fail(cli::ExitCode::file, "cannot write to standard output");
        return code == 0 ? output_code : code;
    }
    return code;
}
