// The program `pt`: chooses the command, and turns every exception into an exit code. `pt NAME ...` runs `pt-NAME ...`
// if NAME is not one of its own commands, as git and cargo do.
#include "cli/base/devices.h"
#include "cli/base/exit_code.h"
#include "cli/base/text.h"
#include "cli/commands.h"

#include <CLI/CLI.hpp>

#include <algorithm>
#include <cerrno>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <exception>
#include <fcntl.h>
#include <filesystem>
#include <iostream>
#include <new>
#include <string>
#include <string_view>
#include <unistd.h>
#include <vector>

namespace {

// Keeps the numbers of closed standard streams from being given to other files, into which output would then be
// written. Call it before any file is opened. A closed stream still fails with EBADF afterwards.
void occupy_closed_streams() {
    for (const int stream : {STDIN_FILENO, STDOUT_FILENO, STDERR_FILENO}) {
        if (fcntl(stream, F_GETFD) == -1 && errno == EBADF) {
            // open() takes the lowest free number. That is this stream's, since those below it are in use.
            static_cast<void>(open("/dev/null", stream == STDIN_FILENO ? O_WRONLY : O_RDONLY));
        }
    }
}

int fail(cli::ExitCode code, const std::string &message) {
    cli::print_message(message);
    return static_cast<int>(code);
}

// The path of a program in the first absolute folder of PATH that has it; empty if there is none. Empty and relative
// entries are skipped, so that nothing in the current folder is run.
std::string find_program(const std::string &file) {
    const char *variable = std::getenv("PATH");
    std::istringstream folders(variable == nullptr ? "" : variable);
    for (std::string folder; std::getline(folders, folder, ':');) {
        const std::filesystem::path path = std::filesystem::path(folder) / file;
        std::error_code ignored;
        if (path.is_absolute() && std::filesystem::is_regular_file(path, ignored) && access(path.c_str(), X_OK) == 0)
            return path;
    }
    return {};
}

// Replaces this process by `pt-NAME`. arguments begins with NAME and ends with a null pointer. Returns only if there is
// no such program.
void run_other_program(std::string_view name, char *const *arguments) {
    std::string program = find_program("pt-" + std::string(name));
    if (program.empty())
        return;
    std::vector<char *> passed{program.data()};
    do
        passed.push_back(*++arguments);
    while (passed.back() != nullptr);
    execv(program.c_str(), passed.data());
    throw cli::Failure(cli::ExitCode::file, program + ": cannot be run: " + std::strerror(errno));
}

// Whether a word may follow `pt-` in the name of a program: files and paths may not.
bool may_name_program(std::string_view name) {
    constexpr std::string_view letters = "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789-_";
    return !name.empty() && name.front() != '-' && name.find_first_not_of(letters) == std::string_view::npos;
}

// The argument of pip install that installs the program of that name; empty for programs that do not belong to this
// project.
std::string_view package_of(std::string_view name) {
    return name == "figure"    ? "'./lib/python[figure]'"
           : name == "tachyon" ? "./lib/python"
           : name == "farm"    ? "'./lib/python[farm]'"
           : name == "view"    ? "'./lib/python[figure,view]'"
                               : "";
}

int run(int argument_count, char **arguments) {
    CLI::App program("An offscreen path tracer for spheres and planes on any Vulkan device", "pt");
    cli::Run chosen;
    program.require_subcommand(0, 1);
    program.formatter(cli::help_formatter());
    program.footer("pt NAME runs the program pt-NAME, where NAME is none of these commands: figure, farm and tachyon\n"
                   "come with the Python package.\n\n" +
                   std::string(cli::exit_code_help));
    program.set_version_flag("--version", "pt " + cli::version_text(), "Print the version and exit");
    program.set_help_flag("-h,--help", "Print this help and exit");
    for (const auto add :
         {cli::add_render_command, cli::add_tonemap_command, cli::add_compare_command, cli::add_merge_command,
          cli::add_denoise_command, cli::add_selftest_command, cli::add_schema_command, cli::add_devices_command})
        add(program, chosen);

    const std::string name = argument_count > 1 ? arguments[1] : "";
    const std::vector<std::string> own = cli::command_names(program);
    if (may_name_program(name) && std::ranges::find(own, name) == own.end()) {
        run_other_program(name, arguments + 1);
        if (const std::string_view package = package_of(name); !package.empty())
            return fail(cli::ExitCode::usage, cli::concat("there is no pt-", name,
                                                          " in the PATH, which comes with the Python package: "
                                                          "pip install ",
                                                          package));
    }
    try {
        program.parse(argument_count, arguments);
    } catch (const CLI::ParseError &error) {
        if (error.get_exit_code() == static_cast<int>(CLI::ExitCodes::Success))
            return program.exit(error); // --help and --version
        return fail(cli::ExitCode::usage, cli::usage_reason(program, error));
    }
    return chosen ? chosen()
                  : fail(cli::ExitCode::usage, "a command is missing: " + cli::listed(own) + " (see pt --help)");
}

} // namespace

int main(int argument_count, char **arguments) {
    // CLI11 allocates memory in functions that it has declared noexcept.
    std::set_terminate([] {
        std::fputs("pt: out of memory, or an internal error\n", stderr);
        std::_Exit(static_cast<int>(cli::ExitCode::internal));
    });
    occupy_closed_streams();
    int code = 0;
    try {
        code = run(argument_count, arguments);
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
