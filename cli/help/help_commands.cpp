#include "cli/help/help_commands.h"

#include "cli/base/common_options.h"
#include "cli/base/exit_code.h"
#include "cli/base/source_date.h"
#include "cli/help/completion.h"
#include "cli/help/man_page.h"
#include "cli/help/value_words.h"
#include "cli/render/render_report.h"

#include <CLI/CLI.hpp>
#include <pt/pt.h>

#include <algorithm>
#include <iostream>
#include <vector>

namespace cli {
namespace {

std::vector<std::string_view> command_names(const CLI::App &program) {
    std::vector<std::string_view> names;
    for (const CLI::App *command : program.get_subcommands([](const CLI::App *) { return true; })) {
        names.push_back(command->get_name());
    }
    return names;
}

} // namespace

const char *const completion_help = "Packages install the scripts where shells look for them. By hand: bash reads "
                                    "`source <(pt completion bash)`, best in\n"
                                    "~/.bashrc; zsh takes the output as a file _pt in a folder of its fpath; fish as\n"
                                    "~/.config/fish/completions/pt.fish.\n";

const char *const man_help = "`pt man render | man -l -` shows one.\n";

void add_completion_options(CLI::App &command, CompletionOptions &options) {
    const auto read = [&options](const std::string &text) {
        if (std::find(shells.begin(), shells.end(), text) == shells.end()) {
            throw CLI::ValidationError("SHELL", unknown_name("shell", text, shells));
        }
        options.shell = text;
    };
    command.add_option_function<std::string>("SHELL", read, "Shell that is to read the script")
        ->required()
        ->type_name(alternatives(shells));
}

void add_man_options(CLI::App &command, const CLI::App &program, ManOptions &options) {
    const std::vector<std::string_view> names = command_names(program);
    const auto read = [&options, &program](const std::string &text) {
        const std::vector<std::string_view> known = command_names(program);
        if (std::find(known.begin(), known.end(), text) == known.end()) {
            throw CLI::ValidationError("COMMAND", unknown_name("command", text, known));
        }
        options.command = text;
    };
    command.add_option_function<std::string>("COMMAND", read, "What is described, without it the program")
        ->type_name(alternatives(names));
}

int run_completion(const CompletionOptions &options, const CLI::App &program) {
    std::cout << completion_script(options.shell, command_text(program));
    return static_cast<int>(ExitCode::done);
}

int run_man(const ManOptions &options, const CLI::App &program) {
    const CommandText all = command_text(program);
    const auto is_meant = [&](const CommandText &command) { return command_word(command) == options.command; };
    const auto found = std::find_if(all.commands.begin(), all.commands.end(), is_meant);
    const std::string date = source_date().substr(0, 10); // "2001:09:09"
    std::string day = date;
    std::replace(day.begin(), day.end(), ':', '-');
    std::cout << man_page(found == all.commands.end() ? all : *found, all, version_text(), day);
    return static_cast<int>(ExitCode::done);
}

} // namespace cli
