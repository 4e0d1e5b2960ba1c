#include "cli/selftest/selftest_command.h"

#include "cli/base/common_options.h"
#include "cli/base/context.h"
#include "cli/base/exit_code.h"
#include "cli/base/json_text.h"
#include "cli/base/output_file.h"
#include "cli/base/vector_width.h"
#include "cli/selftest/selftest_report.h"
#include "cli/selftest/selftest_run.h"

namespace cli {

const char *const selftest_help =
    "Compares the kernel's functions with double precision, small scenes with closed forms, and images whose samples\n"
    "were split over calls bit by bit. A bound is what every right device keeps: for functions by the precision that\n"
    "Vulkan promises; for scenes by that of float32 and their noise, which fails a right device once in a million,\n"
    "as do directions.\n"
    "Paste the output into a report of a fault.\n";

void add_selftest_options(CLI::App &command, SelftestOptions &options) {
    add_device(command, options.device);
    add_text(command, "--json", options.json, "JSON",
             "Write the same as JSON; - is standard output, the text then goes to stderr");
    command.add_flag("--directions", options.directions,
                     "Check the directions that kernels sample alone: means, second moments and sides");
    add_shader_dir(command, options.shader_dir);
}

int run_selftest(const SelftestOptions &options) {
    check_report_file(options.json);
    choose_vector_width();
    pt_create_info info{};
    info.struct_size = sizeof(pt_create_info);
    info.device = options.device.empty() ? nullptr : options.device.c_str();
    info.shader_dir = options.shader_dir.empty() ? nullptr : options.shader_dir.c_str();
    const Context context(info);
    SelftestReport report{};
    context.require(pt_get_context_device(context.get(), &report.device));
    report.checks = options.directions ? run_direction_checks(context) : run_selftest_checks(context);

    print_for_people(selftest_text(report), options.json == standard_stream);
    write_report_file(options.json, json_text(selftest_json(report)));
    return static_cast<int>(report.passed() ? ExitCode::done : ExitCode::internal);
}

} // namespace cli
