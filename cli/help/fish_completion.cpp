#include "cli/help/completion.h"

#include "cli/help/value_words.h"

namespace cli {
namespace {

std::string fish_text(const std::string &text) {
    std::string escaped = "'";
    for (const char letter : text) {
        escaped += (letter == '\'' || letter == '\\') ? "\\" : "";
        escaped += letter;
    }
    return escaped + "'";
}

// The option -a of `complete`, with a blank before it; empty if nothing can be completed.
std::string fish_candidates(const std::string &value) {
    const ValueWords known = value_words(value);
    if (known.is_list) {
        return " -a '(__fish_complete_list , \"string split \\\\  -- " + in_one_line(known.words) + "\")'";
    }
    if (known.is_folder) {
        return " -a '(__fish_complete_directories)'";
    }
    if (known.is_file) {
        return " -a '(__pt_files " + in_one_line(known.endings) + ")'";
    }
    return known.words.empty() ? "" : " -a " + fish_text(in_one_line(known.words));
}

std::string option_line(const std::string &start, const OptionText &option) {
    std::string line = start;
    for (const std::string &name : option.names) {
        line += name.starts_with("--") ? " -l " + name.substr(2) : " -s " + name.substr(1);
    }
    if (!option.value.empty()) {
        line += (option.value_may_lack ? " -f" : " -x") + fish_candidates(option.value);
    }
    return line + " -d " + fish_text(brief(option.description)) + "\n";
}

std::string fish_lines(const std::string &start, const CommandText &command) {
    std::string lines;
    for (const OptionGroup &group : command.groups) {
        for (const OptionText &option : group.options) {
            lines += option_line(start, option);
        }
    }
    for (const ArgumentText &argument : command.arguments) {
        const std::string candidates = fish_candidates(argument.value);
        lines += candidates.empty() ? "" : start + candidates + "\n";
    }
    return lines;
}

// fish itself would offer files of all endings.
constexpr const char *fish_functions = R"(# Completion of pt's command lines for fish, made by `pt completion fish`.

function __pt_files --description 'Files with one of these endings, and folders; all files without endings'
    set -l word (string replace -r '^--[^=]*=' '' -- (commandline -ct))
    for path in (complete -C "__fish_command_without_completions $word" | string replace -r '\t.*' '')
        if not set -q argv[1]; or string match -q '*/' -- $path
            echo $path
        else
            for ending in $argv
                string match -q -- "*$ending" $path; and echo $path
            end
        end
    end
end

complete -c pt -f
)";

} // namespace

std::string fish_completion(const CommandText &program) {
    std::string script = fish_functions + fish_lines("complete -c pt -n __fish_use_subcommand", program);
    for (const CommandText &command : program.commands) {
        const std::string word = command_word(command);
        script += "\ncomplete -c pt -n __fish_use_subcommand -a " + word + " -d " + fish_text(command.description) +
                  "\n" + fish_lines("complete -c pt -n '__fish_seen_subcommand_from " + word + "'", command);
    }
    return script;
}

} // namespace cli
