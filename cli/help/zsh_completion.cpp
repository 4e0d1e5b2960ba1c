#include "cli/help/completion.h"

#include "cli/help/value_words.h"

namespace cli {
namespace {

// Within single quotes, and for _arguments and _describe, which part by colons and brackets.
std::string zsh_text(const std::string &text) {
    std::string escaped;
    for (const char letter : text) {
        if (letter == '\'') {
            escaped += "'\\''";
        } else {
            escaped += (letter == ':' || letter == '[' || letter == ']' || letter == '\\') ? "\\" : "";
            escaped += letter;
        }
    }
    return escaped;
}

std::string in_parentheses(const std::vector<std::string> &words) {
    return std::string("(").append(in_one_line(words)).append(")");
}

// One ending in parentheses would be taken for qualifiers of the glob.
std::string glob_of(const std::vector<std::string_view> &endings) {
    std::string all = endings.size() == 1 ? "*" : "*(";
    for (const std::string_view ending : endings) {
        all.append(all.size() > 2 ? "|" : "").append(ending);
    }
    return all + (endings.size() == 1 ? "" : ")");
}

// What follows a description in an argument of _arguments: ":kind of value:how to complete it".
std::string zsh_action(const std::string &value) {
    const ValueWords known = value_words(value);
    std::string action = ":";
    action.append(zsh_text(value)).append(":");
    if (known.is_list) {
        action += "_sequence compadd - " + in_one_line(known.words);
    } else if (known.is_folder) {
        action += "_files -/";
    } else if (known.is_file) {
        action += known.endings.empty() ? "_files" : "_files -g \"" + glob_of(known.endings) + "\"";
    } else if (!known.words.empty()) {
        action += in_parentheses(known.words);
    }
    return action;
}

// One line for every name, each of which excludes the others of its option.
std::string option_lines(const OptionText &option) {
    std::string lines;
    const std::string exclusion = option.may_repeat ? "*" : in_parentheses(option.names);
    for (const std::string &name : option.names) {
        lines.append("            '").append(exclusion).append(name);
        if (!option.value.empty()) {
            lines += name.starts_with("--") ? "=" : "+";
        }
        lines.append("[").append(zsh_text(brief(option.description))).append("]");
        if (!option.value.empty()) {
            lines.append(option.value_may_lack ? ":" : "").append(zsh_action(option.value));
        }
        lines += "' \\\n";
    }
    return lines;
}

std::string option_lines(const CommandText &command) {
    std::string lines;
    for (const OptionGroup &group : command.groups) {
        for (const OptionText &option : group.options) {
            lines += option_lines(option);
        }
    }
    return lines;
}

std::string argument_lines(const CommandText &command) {
    std::string lines;
    for (const ArgumentText &argument : command.arguments) {
        lines.append("            '").append(argument.may_repeat ? "*" : "").append(argument.may_lack ? ":" : "");
        lines.append(zsh_action(argument.value)).append("' \\\n");
    }
    return lines;
}

// Without the backslash after its last line.
std::string arguments_call(const std::string &lines) {
    return "        _arguments -s \\\n" + lines.substr(0, lines.size() - 3) + "\n";
}

} // namespace

std::string zsh_completion(const CommandText &program) {
    std::string commands;
    std::string cases;
    for (const CommandText &command : program.commands) {
        commands += "        '" + command_word(command) + ":" + zsh_text(command.description) + "'\n";
        cases += "    " + command_word(command) + ")\n" +
                 arguments_call(option_lines(command) + argument_lines(command)) + "        ;;\n";
    }
    return "#compdef pt\n# Completion of pt's command lines for zsh, made by `pt completion zsh`.\n\n"
           "_pt() {\n    local -a commands=(\n" +
           commands +
           "    )\n    if ((CURRENT == 2)) && [[ $words[2] != -* ]]; then\n"
           "        _describe command commands\n        return\n    fi\n"
           "    local command=$words[2]\n"
           "    shift words # for _arguments the command is the program\n"
           "    ((CURRENT--))\n"
           "    case $command in\n" +
           cases + "    *)\n" + arguments_call(option_lines(program)) +
           "        ;;\n    esac\n}\n\n"
           "# Called by name where zsh has loaded this file as a function, else defined for later.\n"
           "if [[ $funcstack[1] == _pt ]]; then\n    _pt \"$@\"\nelse\n    compdef _pt pt\nfi\n";
}

} // namespace cli
