#include "cli/program.h"

#include "cli/base/devices.h"
#include "cli/base/exit_code.h"
#include "cli/base/text.h"
#include "cli/commands.h"
#include "lib/platform/process.h"

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace cli {

namespace {

// Replaces this program by `pt-NAME`, if it exists.
std::optional<int> run_other_program(std::string_view name, char *const *arguments) {
    const std::filesystem::path program = platform::find_program("pt-" + std::string(name));
    if (program.empty())
        return std::nullopt;
    const int code = platform::run_instead(program, arguments);
    refuse_if(code < 0, program.string() + ": cannot be run: " + std::strerror(errno), ExitCode::file);
    return code;
}

// Refuses names that could be files or paths.
bool may_name_program(std::string_view name) {
    constexpr std::string_view letters = "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789-_";
    return !name.empty() && name.front() != '-' && name.find_first_not_of(letters) == std::string_view::npos;
}

// The argument of pip install. Empty for a program of another project.
std::string_view package_of(std::string_view name) {
    return name == "figure"    ? "'./lib/python[figure]'"
           : name == "tachyon" ? "./lib/python"
           : name == "farm"    ? "'./lib/python[farm]'"
           : name == "view"    ? "'./lib/python[figure,view]'"
                               : "";
}

} // namespace

int run_program(int argument_count, char **arguments) {
    CLI::App program("An offscreen path tracer for spheres and planes on any Vulkan device", "pt");
    Run chosen;
    program.require_subcommand(0, 1);
    program.allow_windows_style_options(false); // /path is not an option.
    program.formatter(help_formatter());
    program.footer("pt NAME runs the program pt-NAME, where NAME is none of these commands: figure, farm and tachyon\n"
                   "come with the Python package.\n\n" +
                   std::string(exit_code_help));
    program.set_version_flag("--version", "pt " + version_text(), "Print the version and exit");
    program.set_help_flag("-h,--help", "Print this help and exit");
    for (const auto add :
         {add_render_command, add_tonemap_command, add_compare_command, add_merge_command, add_denoise_command,
          add_selftest_command, add_course_command, add_schema_command, add_devices_command})
        add(program, chosen);

    const std::string name = argument_count > 1 ? arguments[1] : "";
    const std::vector<std::string> own = command_names(program);
    if (may_name_program(name) && std::ranges::find(own, name) == own.end()) {
        if (const std::optional<int> code = run_other_program(name, arguments))
            return *code;
        if (const std::string_view package = package_of(name); !package.empty())
            throw Failure(ExitCode::usage, concat("there is no pt-", name,
                                                  " in the PATH; it comes with the Python package: "
                                                  "pip install ",
                                                  package));
    }
    try {
        program.parse(argument_count, arguments);
    } catch (const CLI::ParseError &error) {
        if (error.get_exit_code() == static_cast<int>(CLI::ExitCodes::Success))
            return program.exit(error);
        throw Failure(ExitCode::usage, usage_reason(program, error));
    }
    if (!chosen)
        throw Failure(ExitCode::usage, "a command is missing: " + listed(own) + " (see pt --help)");
    return chosen();
}

} // namespace cli
