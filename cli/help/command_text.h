// What a command's help says, as data, read from its options: the help on the terminal, the man pages and the
// completions of shells are all written from it.
#pragma once

#include <string>
#include <vector>

namespace CLI {
class App;
}

namespace cli {

struct OptionText {
    std::vector<std::string> names; // "-o", "--output"
    std::string value;              // what stands for it, see value_words.h; empty: the option takes none
    bool value_may_lack;
    bool may_repeat;
    std::string description; // with what the option needs or excludes
};

struct OptionGroup {
    std::string name;
    std::vector<OptionText> options;
};

struct ArgumentText {
    std::string name;  // "SCENE"
    std::string value; // as of an option
    bool may_lack;
    bool may_repeat;
    std::string description; // with the words that it may be
};

struct CommandText {
    std::string name; // "pt render"
    std::string description;
    std::vector<ArgumentText> arguments;
    std::vector<OptionGroup> groups;
    std::string notes; // paragraphs, see paragraphs.h
    std::vector<CommandText> commands;
};

// The group with --help, which CLI11 has first, comes last.
CommandText command_text(const CLI::App &command);

// "pt render [OPTIONS] SCENE"
std::string usage_text(const CommandText &command);

// "--output IMAGE", "--tev[=HOST:PORT]"
std::string option_with_value(const OptionText &option, const std::string &name);

} // namespace cli
