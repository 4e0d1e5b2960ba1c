#include "cli/help/completion.h"

#include "cli/help/value_words.h"

namespace cli {
namespace {

// What the script does with a value; empty if nothing can be completed.
std::string bash_action(const std::string &value) {
    const ValueWords known = value_words(value);
    if (known.is_list) {
        return "_pt_list " + in_one_line(known.words);
    }
    if (known.is_folder) {
        return "_pt_folders";
    }
    if (known.is_file) {
        return known.endings.empty() ? "_pt_files ''" : "_pt_files " + in_one_line(known.endings);
    }
    return known.words.empty() ? "" : "_pt_words " + in_one_line(known.words);
}

std::string value_cases(const CommandText &command) {
    std::string cases;
    for (const OptionGroup &group : command.groups) {
        for (const OptionText &option : group.options) {
            if (option.value.empty()) {
                continue;
            }
            std::string pattern;
            for (const std::string &name : option.names) {
                pattern += (pattern.empty() ? "" : " | ") + command_word(command) + ":" + name;
            }
            const std::string action = bash_action(option.value);
            cases += "    " + pattern + ") " + (action.empty() ? "return ;;\n" : action + "; return ;;\n");
        }
    }
    return cases;
}

std::string names_case(const CommandText &command) {
    std::vector<std::string> names;
    for (const OptionGroup &group : command.groups) {
        for (const OptionText &option : group.options) {
            names.insert(names.end(), option.names.begin(), option.names.end());
        }
    }
    return "    " + command_word(command) + ":-*) _pt_words " + in_one_line(names) + " ;;\n";
}

// Of whichever argument, for bash does not know which one it is.
std::string argument_case(const CommandText &command) {
    std::string actions;
    for (const ArgumentText &argument : command.arguments) {
        actions += "_pt_add " + bash_action(argument.value) + "; ";
    }
    return actions.empty() ? "" : "    " + command_word(command) + ":*) " + actions + ";;\n";
}

constexpr const char *bash_functions = R"(# Completion of pt's command lines for bash, made by `pt completion bash`.

_pt_add() { # function argument...: adds to what there is already
    local before=("${COMPREPLY[@]}")
    "$@"
    COMPREPLY=("${before[@]}" "${COMPREPLY[@]}")
}

_pt_words() { # word...
    mapfile -t COMPREPLY < <(compgen -W "$*" -- "$word")
}

_pt_list() { # word...: the last of several that commas part
    local before=
    [[ $word != *,* ]] || before=${word%,*},
    mapfile -t COMPREPLY < <(compgen -P "$before" -W "$*" -- "${word##*,}")
    compopt -o nospace
}

_pt_folders() {
    mapfile -t COMPREPLY < <(compgen -d -- "$word")
    compopt -o filenames
}

_pt_files() { # ending...
    local ending
    mapfile -t COMPREPLY < <(compgen -d -- "$word"; for ending; do compgen -f -X "!*$ending" -- "$word"; done)
    compopt -o filenames
}

_pt() {
    local word=${COMP_WORDS[COMP_CWORD]} before=${COMP_WORDS[COMP_CWORD - 1]}
    COMPREPLY=()
    # bash parts "--option=value" at the sign.
    if [[ $word == = ]]; then
        word=
    elif [[ $before == = ]]; then
        before=${COMP_WORDS[COMP_CWORD - 2]}
    fi
    if ((COMP_CWORD == 1)); then
)";

} // namespace

std::string bash_completion(const CommandText &program) {
    std::vector<std::string> firsts;
    std::string values;
    std::string others;
    for (const CommandText &command : program.commands) {
        firsts.push_back(command_word(command));
        values += value_cases(command);
        others += names_case(command) + argument_case(command);
    }
    for (const OptionText &option : program.groups.front().options) {
        firsts.insert(firsts.end(), option.names.begin(), option.names.end());
    }
    return std::string(bash_functions) + "        _pt_words " + in_one_line(firsts) +
           "\n        return\n    fi\n    case ${COMP_WORDS[1]}:$before in\n" + values +
           "    esac\n    case ${COMP_WORDS[1]}:$word in\n" + others + "    esac\n}\n\ncomplete -F _pt pt\n";
}

} // namespace cli
