#include "cli/help/man_page.h"

#include "cli/help/paragraphs.h"

#include <algorithm>
#include <cctype>

namespace cli {
namespace {

// groff takes a line that begins with a dot for a request, and shows a plain hyphen as a typographic one, which cannot
// be searched for or pasted into a shell.
std::string roff(const std::string &text) {
    std::string escaped;
    for (const char letter : text) {
        switch (letter) {
        case '\\':
            escaped += "\\e";
            break;
        case '-':
            escaped += "\\-";
            break;
        case '\'':
            escaped += "\\(aq";
            break;
        case '`':
            escaped += "\\(ga";
            break;
        case '^':
            escaped += "\\(ha";
            break;
        case '~':
            escaped += "\\(ti";
            break;
        case '.':
            escaped += escaped.empty() || escaped.back() == '\n' ? "\\&." : ".";
            break;
        default:
            escaped += letter;
        }
    }
    return escaped;
}

// In lines as short as manual pages are to have them, with room for the escapes.
std::string roff_lines(const std::string &text) {
    constexpr std::size_t width = 62;
    return roff(wrapped(text, 0, width, 0));
}

// "pt-render"
std::string page_name(const CommandText &command) {
    std::string name = command.name;
    std::replace(name.begin(), name.end(), ' ', '-');
    return name;
}

std::string in_capitals(std::string text) {
    std::transform(text.begin(), text.end(), text.begin(),
                   [](unsigned char letter) { return static_cast<char>(std::toupper(letter)); });
    return text;
}

// Within a line that names a page, descriptions are no sentences.
std::string in_line(std::string text) {
    text.front() = static_cast<char>(std::tolower(static_cast<unsigned char>(text.front())));
    return text;
}

std::string tagged(const std::string &tag, const std::string &text) {
    return ".TP\n" + tag + "\n" + roff_lines(text) + "\n";
}

std::string option_entry(const OptionText &option) {
    std::string tag;
    for (const std::string &name : option.names) {
        tag += (tag.empty() ? "\\fB" : ", \\fB") + roff(name) + "\\fR";
    }
    if (!option.value.empty()) {
        tag += (option.value_may_lack ? " [\\fI" : " \\fI") + roff(option.value) +
               (option.value_may_lack ? "\\fR]" : "\\fR");
    }
    return tagged(tag, option.description);
}

std::string arguments_section(const CommandText &command) {
    std::string section = command.arguments.empty() ? "" : ".SH ARGUMENTS\n";
    for (const ArgumentText &argument : command.arguments) {
        section +=
            tagged("\\fI" + roff(argument.name) + "\\fR" + (argument.may_repeat ? "..." : ""), argument.description);
    }
    return section;
}

std::string commands_section(const CommandText &command) {
    std::string section = command.commands.empty() ? "" : ".SH COMMANDS\n";
    for (const CommandText &each : command.commands) {
        section += tagged("\\fB" + roff(page_name(each)) + "\\fR(1)", each.description);
    }
    return section;
}

std::string options_section(const CommandText &command) {
    std::string section = ".SH OPTIONS\n";
    for (const OptionGroup &group : command.groups) {
        section += command.groups.size() > 1 ? ".SS " + roff(group.name) + "\n" : "";
        for (const OptionText &option : group.options) {
            section += option_entry(option);
        }
    }
    return section;
}

std::string notes_sections(const CommandText &command) {
    std::string text;
    std::string tables;
    for (const Paragraph &paragraph : paragraphs(command.notes)) {
        if (paragraph.rows.empty()) {
            text += (text.empty() ? ".SH NOTES\n" : ".PP\n") + roff_lines(paragraph.text) + "\n";
            continue;
        }
        tables += ".SH " + roff(in_capitals(paragraph.title)) + "\n";
        for (const TableRow &row : paragraph.rows) {
            tables += tagged("\\fB" + roff(row.key) + "\\fR", row.text);
        }
        tables += paragraph.text.empty() ? "" : ".PP\n" + roff_lines(paragraph.text) + "\n";
    }
    return text + tables;
}

std::string references_section(const CommandText &command, const CommandText &program) {
    std::string names;
    const auto add = [&](const CommandText &other) {
        if (other.name != command.name) {
            names += (names.empty() ? ".BR " : ",\n.BR ") + roff(page_name(other)) + " (1)";
        }
    };
    add(program);
    std::for_each(program.commands.begin(), program.commands.end(), add);
    return ".SH SEE ALSO\n" + names + "\n";
}

} // namespace

std::string man_page(const CommandText &command, const CommandText &program, const std::string &version,
                     const std::string &date) {
    const std::string usage = usage_text(command);
    return ".TH " + roff(in_capitals(page_name(command))) + " 1 \"" + date + "\" \"pt " + roff(version) +
           "\" \"User Commands\"\n.SH NAME\n" + roff(page_name(command)) + " \\- " +
           roff(in_line(command.description)) + "\n.SH SYNOPSIS\n\\fB" + roff(command.name) + "\\fR" +
           roff(usage.substr(command.name.size())) + "\n.SH DESCRIPTION\n" + roff(command.description) + ".\n" +
           arguments_section(command) + commands_section(command) + options_section(command) + notes_sections(command) +
           references_section(command, program);
}

} // namespace cli
