// The program `pt`: chooses the command, and turns every exception into an exit code.
#include "cli/base/devices.h"
#include "cli/base/exit_code.h"
#include "cli/base/json_text.h"
#include "cli/base/message.h"
#include "cli/base/other_program.h"
#include "cli/base/text.h"
#include "cli/base/usage.h"
#include "cli/compare/compare_command.h"
#include "cli/merge/merge_command.h"
#include "cli/render/render_command.h"
#include "cli/scene/scene_keys.h"
#include "cli/selftest/selftest_command.h"
#include "cli/tonemap/tonemap_command.h"

#include <CLI/CLI.hpp>

#include <algorithm>
#include <cerrno>
#include <cstdio>
#include <cstdlib>
#include <exception>
#include <fcntl.h>
#include <functional>
#include <iostream>
#include <memory>
#include <new>
#include <nlohmann/json.hpp>
#include <string>
#include <string_view>
#include <unistd.h>
#include <vector>

namespace {

// Keeps the numbers of closed standard streams from going to other files: what is printed would be written into them.
// To be called before any file is opened. A stream that is closed fails afterwards as it did before, with EBADF.
void occupy_closed_streams() {
    for (const int stream : {STDIN_FILENO, STDOUT_FILENO, STDERR_FILENO}) {
        if (fcntl(stream, F_GETFD) == -1 && errno == EBADF) {
            // The lowest number that is free, which is this one: those before it are in use.
            static_cast<void>(open("/dev/null", stream == STDIN_FILENO ? O_WRONLY : O_RDONLY));
        }
    }
}

int fail(cli::ExitCode code, const std::string &message) {
    cli::print_message(message);
    return static_cast<int>(code);
}

// The program with its commands, each of which says where its options go and what it runs.
class Program {
public:
    Program() {
        app_.require_subcommand(0, 1);
        app_.formatter(std::make_shared<cli::HelpFormatter>());
        app_.footer(
            "pt NAME runs the program pt-NAME, where NAME is none of these commands: figure, farm and tachyon come\n"
            "with the Python package.\n\n" +
            std::string(cli::exit_code_help));
        app_.set_version_flag("--version", "pt " + cli::version_text(), "Print the version and exit");
        say_help(app_);
        add_commands();
    }

    int run(int argument_count, char **arguments) {
        const std::string_view name = argument_count > 1 ? arguments[1] : "";
        const std::vector<std::string> own = names();
        if (cli::may_name_program(name) && std::ranges::find(own, name) == own.end()) {
            cli::run_other_program(name, arguments + 1);
            if (const std::string_view how = cli::installation_of(name); !how.empty())
                return fail(cli::ExitCode::usage,
                            "there is no pt-" + std::string(name) + " in the PATH, which " + std::string(how));
        }
        try {
            app_.parse(arguments_of(argument_count, arguments));
        } catch (const CLI::ParseError &error) {
            if (error.get_exit_code() == static_cast<int>(CLI::ExitCodes::Success))
                return app_.exit(error); // --help and --version
            return fail(cli::ExitCode::usage, cli::usage_reason(app_, error));
        }
        for (const Command &command : commands_)
            if (command.app->parsed())
                return command.run();
        return fail(cli::ExitCode::usage, "a command is missing: " + cli::listed(names()) + " (see pt --help)");
    }

private:
    // Without the program's name, the last first, as CLI11 takes them. Those behind "--" are files, whatever their
    // names: CLI11 takes it for the end of a list of values, and none for a part of an option that "./" stands before.
    static std::vector<std::string> arguments_of(int argument_count, char **arguments) {
        std::vector<std::string> given(arguments + std::min(argument_count, 1), arguments + argument_count);
        if (const auto mark = std::find(given.begin(), given.end(), "--"); mark != given.end()) {
            for (auto file = given.erase(mark); file != given.end(); ++file)
                if (file->starts_with('-') && file->size() > 1)
                    file->insert(0, "./");
        }
        std::reverse(given.begin(), given.end());
        return given;
    }

    struct Command {
        CLI::App *app;
        std::function<int()> run;
    };

    static void say_help(CLI::App &app) { app.set_help_flag("-h,--help", "Print this help and exit"); }

    CLI::App &add(const std::string &name, const std::string &description, const std::string &notes,
                  std::function<int()> run) {
        CLI::App *app = app_.add_subcommand(name, description);
        app->group("Commands");
        app->footer(notes + (notes.empty() ? "" : "\n") + cli::exit_code_help);
        say_help(*app);
        commands_.push_back({app, std::move(run)});
        return *app;
    }

    template <typename Options>
    void add(const std::string &name, const std::string &description, const std::string &notes,
             void (*add_options)(CLI::App &, Options &), int (*run_command)(const Options &), Options &options) {
        add_options(add(name, description, notes, [run_command, &options] { return run_command(options); }), options);
    }

    void add_commands() {
        add("render", "Render a scene file to images", cli::render_help, &cli::add_render_options, &cli::run_render,
            render_);
        add("tonemap", "Make a picture of a file of radiance, without rendering", cli::tonemap_help,
            &cli::add_tonemap_options, &cli::run_tonemap, tonemap_);
        add("compare", "Compare an image with a reference", cli::compare_help, &cli::add_compare_options,
            &cli::run_compare, compare_);
        add("merge", "Add films of one picture that were rendered apart", cli::merge_help, &cli::add_merge_options,
            &cli::run_merge, merge_);
        add("selftest", "Check a device against exact answers, in a second or so", cli::selftest_help,
            &cli::add_selftest_options, &cli::run_selftest, selftest_);
        add("schema", "Print the JSON Schema of scene files", "", [] {
            std::cout << cli::json_text(cli::scene_schema());
            return static_cast<int>(cli::ExitCode::done);
        });
        add("devices", "List the Vulkan devices", "", [this] {
            return cli::run_devices(devices_as_json_);
        }).add_flag("--json", devices_as_json_, "Print JSON");
    }

    std::vector<std::string> names() const {
        std::vector<std::string> all;
        for (const Command &command : commands_)
            all.push_back(command.app->get_name());
        return all;
    }

    CLI::App app_{"An offscreen path tracer for spheres and planes on any Vulkan device", "pt"};
    std::vector<Command> commands_;
    cli::RenderOptions render_;
    cli::TonemapOptions tonemap_;
    cli::CompareOptions compare_;
    cli::MergeOptions merge_;
    cli::SelftestOptions selftest_;
    bool devices_as_json_ = false;
};

} // namespace

int main(int argument_count, char **arguments) {
    // CLI11 allocates where it has promised not to throw.
    std::set_terminate([] {
        std::fputs("pt: out of memory, or an internal error\n", stderr);
        std::_Exit(static_cast<int>(cli::ExitCode::internal));
    });
    occupy_closed_streams();
    int code = 0;
    try {
        code = Program().run(argument_count, arguments);
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
